//! Family of scores computed from distances in the planes of position and of shear force.

use taceva_core::{Batch, Channels, SkipReason, Unit};

use crate::evaluate::family::{Family, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::ColumnAdder;
use crate::exact::record::Record;
use crate::families::accuracy::plane_sums::PlaneSums;
use crate::families::row_columns::Gathered;
use crate::pair::{Paired, is_valid};
use crate::score::value::{Finished, UndefinedReason};

/// Two channels that are the axes of a plane.
#[derive(Clone, Debug)]
pub(crate) struct PlaneAxes {
    label: &'static str,
    names: [&'static str; 2],
    unit: Unit,
    /// Index of each axis in the list of channels.
    pub(crate) axes: [usize; 2],
}

impl PlaneAxes {
    /// Output of the plane, with its sums at index 0.
    pub(crate) fn output(&self) -> Output {
        Output {
            label: self.label.to_owned(),
            unit: self.unit,
            of: self.names.map(str::to_owned).to_vec(),
            parts: vec![0],
        }
    }
}

/// Planes of two channels: name, axes and unit. Planes have scores, but models do not predict them.
pub const PLANES: [(&str, [&str; 2], Unit); 2] = [
    ("Pxy", ["Px", "Py"], Unit::Millimetre),
    ("Fxy", ["Fx", "Fy"], Unit::Newton),
];

/// Axes of the plane called `name`; `None` for a channel name.
pub fn plane_axes(name: &str) -> Option<[&'static str; 2]> {
    let mut planes = PLANES.into_iter();
    planes.find_map(|(plane, axes, _)| (plane == name).then_some(axes))
}

/// Name of the plane that has the axis `channel`; `None` if no plane has it.
pub fn plane_of(channel: &str) -> Option<&'static str> {
    let mut planes = PLANES.into_iter();
    planes.find_map(|(plane, axes, _)| axes.contains(&channel).then_some(plane))
}

/// Planes whose axes are both in `channels`.
pub(crate) fn planes(channels: &Channels) -> Vec<PlaneAxes> {
    let spanned = PLANES.into_iter().filter_map(|(label, names, unit)| {
        Some(PlaneAxes {
            label,
            names,
            unit,
            axes: [channels.position(names[0])?, channels.position(names[1])?],
        })
    });
    spanned.collect()
}

/// Computes the value of a metric from the distances in one plane.
pub(crate) struct PlaneFormula(pub(crate) fn(&PlaneSums) -> Finished);

/// Family of metrics computed from the distance between prediction and truth in a plane.
pub(crate) static PLANE: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    obstacle: Plane::obstacle,
    ..FamilyKind::new("taceva.plane/1", |plan| {
        erased(Plane::for_channels(plan.channels())?)
    })
};

/// Sums of the distances in each plane.
pub(crate) struct Plane {
    planes: Vec<PlaneAxes>,
    outputs: Vec<Output>,
    /// One column adder for each plane, because the values of planes differ in magnitude.
    adders: Vec<ColumnAdder>,
    gathered: Gathered,
    distances: Vec<f64>,
}

impl Plane {
    /// Family for the planes of `channels`; `None` if no plane has both axes in `channels`.
    fn for_channels(channels: &Channels) -> Option<Plane> {
        let planes = planes(channels);
        if planes.is_empty() {
            return None;
        }
        let outputs = planes.iter().enumerate().map(|(position, plane)| Output {
            parts: vec![position],
            ..plane.output()
        });
        let outputs = outputs.collect();
        Some(Plane {
            adders: vec![ColumnAdder::new(Vec::new()); planes.len()],
            planes,
            outputs,
            gathered: Gathered::default(),
            distances: Vec::new(),
        })
    }
}

impl Plane {
    /// Name of an axis that `channels` lack; `None` if they have both axes of a plane. A plane with one axis in `channels` comes first.
    fn missing_axis(channels: &Channels) -> Option<&'static str> {
        if !planes(channels).is_empty() {
            return None;
        }
        let present = |name: &str| channels.position(name).is_some();
        let half = PLANES
            .into_iter()
            .find(|(_, axes, _)| axes.iter().any(|axis| present(axis)));
        let (_, axes, _) = half.unwrap_or(PLANES[0]);
        axes.into_iter().find(|axis| !present(axis))
    }
}

impl Plane {
    /// Reason to skip the family: the plan lacks an axis of every plane. `None` if a plane has both axes.
    fn obstacle(plan: &MetricPlan) -> Option<SkipReason> {
        let axis = Plane::missing_axis(plan.channels())?;
        Some(SkipReason::ChannelAbsent(axis.to_owned()))
    }
}

impl Family for Plane {
    type Sums = PlaneSums;

    fn empty(&self) -> Vec<PlaneSums> {
        vec![PlaneSums::default(); self.planes.len()]
    }

    fn deposit(&mut self, sums: &mut [PlaneSums], batch: &Batch, rows: Option<&[u32]>) {
        for ((plane, adder), sums) in self.planes.iter().zip(&mut self.adders).zip(sums) {
            let [x, y] = plane.axes;
            let columns = [
                batch.prediction(x),
                batch.truth(x),
                batch.prediction(y),
                batch.truth(y),
            ];
            let columns = self.gathered.rows(&columns, rows);
            let pairs = |at: usize| {
                Paired {
                    estimate: columns[at],
                    reference: columns[at + 1],
                }
                .iter()
            };
            self.distances.clear();
            for (x, y) in pairs(0).zip(pairs(2)) {
                match PlaneSums::distance_of(x, y).filter(|distance| is_valid(*distance)) {
                    Some(distance) => self.distances.push(distance),
                    // An unusable distance is skipped. A distance beyond the range of columns is added alone.
                    None => sums.add(x, y),
                }
            }
            adder.add(&[&self.distances], sums);
        }
    }

    fn to_record(&self, sums: &PlaneSums) -> Record {
        Record {
            counts: vec![sums.n, sums.n_invalid],
            sums: vec![sums.distance.clone()],
            ..Record::default()
        }
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<PlaneSums, String> {
        let ([n, n_invalid], [distance]) = record.exactly()?;
        Ok(PlaneSums {
            n: *n,
            n_invalid: *n_invalid,
            distance: distance.clone(),
        })
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        self.outputs.clone()
    }

    fn count(&self, _metric: &Metric, sums: &PlaneSums) -> u64 {
        sums.n()
    }

    fn invalid(&self, sums: &PlaneSums) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, metric: &Metric, _output: &Output, sums: &PlaneSums) -> Numbers {
        let formula = metric.formula.get::<PlaneFormula>();
        Numbers::of(formula.map_or(Err(UndefinedReason::Empty), |formula| (formula.0)(sums)))
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Channel;

    use super::{PLANES, plane_axes, plane_of};
    use crate::evaluate::{Evaluator, Rows};
    use crate::pair::GREATEST;

    #[test]
    fn an_axis_names_its_plane_and_a_plane_its_axes() {
        for (plane, axes, _) in PLANES {
            assert_eq!(plane_axes(plane), Some(axes));
            assert!(axes.iter().all(|axis| plane_of(axis) == Some(plane)));
        }
        assert_eq!((plane_axes("Pz"), plane_of("Fz")), (None, None));
    }

    #[test]
    fn a_distance_beyond_usable_numbers_is_summed_all_the_same() {
        let (far, near) = ([GREATEST; 20], [-GREATEST; 20]);
        let mut evaluator = Evaluator::of_channels([Channel::FX, Channel::FY]).expect("two");
        let rows = Rows::new()
            .pairs(Channel::FX, far, near)
            .pairs(Channel::FY, near, far);
        evaluator.update_rows(rows).expect("its channels");
        let scores = evaluator.finish().expect("nothing collected");
        let score = scores.score("mae_euclid", "Fxy").expect("a score");
        let distance = 2.0_f64.powf(1022.5);
        assert!(distance > GREATEST && (score.n, score.n_invalid) == (20, 0));
        let found = score.value.scalar().expect("a distance");
        assert!((found / distance - 1.0).abs() < 1e-14, "{found:e}");
    }
}
