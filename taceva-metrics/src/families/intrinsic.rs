//! Properties of the sensor derived from its recording: frame rate and sensing area.

mod sums;
pub(crate) mod times;

use std::borrow::Cow;

use taceva_core::{Batch, Field, FieldSet, Labels, Needs, SkipReason, Unit};

use crate::evaluate::family::{Details, Family, FamilyKind, Numbers, Output, each_row, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::evaluate::plan::MetricPlan;
use crate::exact::record::Record;
use crate::score::Count;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};
use sums::IntrinsicSums;
use times::Intervals;

pub(crate) static INTRINSIC: Metric = Metric {
    id: "intrinsic",
    title: "properties of the sensor",
    theme: Theme::Camera,
    better: Better::Described,
    unit: ScoreUnit::OfChannel,
    range: Range::NotNegative,
    definition: "intrinsic/2",
    reference: "TacEva, intrinsic properties; measured from the recording",
    documentation: "`frame_rate`: one over the median interval between successive times; samples at one time are one frame. If that \
                    interval exceeds 1 s, these are single pictures, and rate, jitter and gaps are undefined. `jitter`: standard \
                    deviation (over n − 1) of the intervals without gaps. `dropped`: share of intervals that are a gap, longer than 1.5 \
                    medians. `duplicated`: share of frames that equal the previous frame, bit for bit. `field_of_view`: area of the convex \
                    hull of the true places with |true Fz| ≥ 0.02 N, or with true Pz > 0 if no force is measured. `resolution`: pixels \
                    of a picture, as declared. These values describe the recording: the field of view omits a rim that was never pressed, and \
                    pauses count as gaps.",
    needs: Needs::new(FieldSet::EMPTY),
    ..Metric::of(&KIND)
};

/// Fields that the metric reads if samples have them.
pub(crate) const OPTIONAL_FIELDS: FieldSet = FieldSet::EMPTY
    .with(Field::Truth)
    .with(Field::Stamp)
    .with(Field::FrameDigest);

/// Properties with their units, in the order of reports.
const PROPERTIES: [(&str, Unit); 6] = [
    ("frame_rate", Unit::Hertz),
    ("jitter", Unit::Second),
    ("dropped", Unit::One),
    ("duplicated", Unit::One),
    ("field_of_view", Unit::SquareMillimetre),
    ("resolution", Unit::Pixel),
];

/// Family of metrics computed from times of frames, digests of frames and places of contact.
pub(crate) static KIND: FamilyKind = FamilyKind {
    optional: OPTIONAL_FIELDS,
    obstacle: Intrinsic::obstacle,
    ..FamilyKind::new("taceva.intrinsic/1", |plan| {
        erased(Intrinsic::for_plan(plan))
    })
};

/// Collects times of frames, digests of frames and places of contact.
pub(crate) struct Intrinsic {
    place: Option<[usize; 2]>,
    contact: Option<Contact>,
    frame_size: Option<[u32; 2]>,
}

/// Criterion by which a sample counts as in contact.
#[derive(Clone, Copy, Debug)]
enum Contact {
    /// |Fz| of at least 0.02 N, in the channel at this index.
    Force(usize),
    /// Positive indentation, in the channel at this index.
    Depth(usize),
}

impl Contact {
    /// True if the sample at `row` is in contact; `None` if the channel has no value.
    fn at(self, batch: &Batch, row: usize) -> Option<bool> {
        /// Contact threshold, N.
        const GATE_N: f64 = 0.02;
        match self {
            Contact::Force(position) => Some(batch.truth(position).get(row)?.abs() >= GATE_N),
            Contact::Depth(position) => Some(batch.truth(position).get(row)? > 0.0),
        }
    }
}

impl Intrinsic {
    /// Creates the family for `plan`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Intrinsic {
        let position = |name| plan.channels().position(name);
        let place = position("Px").zip(position("Py"));
        let by_depth = || position("Pz").map(Contact::Depth);
        Intrinsic {
            place: place.map(|(x, y)| [x, y]),
            contact: position("Fz").map(Contact::Force).or_else(by_depth),
            frame_size: plan.facts().frame_size,
        }
    }

    /// Reason to skip the family: samples have neither times nor true places, and the frame size is unknown. `None` otherwise.
    pub(crate) fn obstacle(plan: &MetricPlan) -> Option<SkipReason> {
        let named = |name| plan.channels().position(name).is_some();
        let places = plan.carries(Field::Truth) && named("Px") && named("Py");
        let any = plan.carries(Field::Stamp) || places || plan.facts().frame_size.is_some();
        (!any).then_some(SkipReason::FieldAbsent(Field::Stamp))
    }

    /// True place of the sample at `row`, mm; `None` without contact or place.
    fn contact_mm(&self, batch: &Batch, row: usize) -> Option<[f64; 2]> {
        let [x, y] = self.place?;
        self.contact?.at(batch, row).filter(|contact| *contact)?;
        Some([batch.truth(x).get(row)?, batch.truth(y).get(row)?])
    }

    /// Number of pixels of a frame: width times height.
    fn resolution(&self) -> Finished {
        let [width, height] = self
            .frame_size
            .ok_or(UndefinedReason::NotDeclared("frame_size"))?;
        Ok(f64::from(width) * f64::from(height))
    }
}

impl Family for Intrinsic {
    type Sums = IntrinsicSums;

    fn empty(&self) -> Vec<IntrinsicSums> {
        vec![IntrinsicSums::default()]
    }

    fn deposit(&mut self, sums: &mut [IntrinsicSums], batch: &Batch, rows: Option<&[u32]>) {
        let [sums] = sums else { return };
        let times = batch.numbers(Field::Stamp);
        let digests = batch.labels(Field::FrameDigest);
        let mut places = Vec::new();
        each_row(batch, rows, |row| {
            if let Some(time) = times.and_then(|times| times.get(row)) {
                sums.add_time(time, digests.and_then(|digests| digests.get(row)));
            }
            places.extend(self.contact_mm(batch, row));
        });
        sums.add_contacts(&places);
    }

    /// All samples form one cluster, because a time interval needs the previous sample.
    fn clusters<'a>(&self, _batch: &'a Batch) -> Option<Cow<'a, Labels>> {
        None
    }

    fn to_record(&self, sums: &IntrinsicSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<IntrinsicSums, String> {
        IntrinsicSums::read_record(record)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        let outputs = PROPERTIES.iter().map(|&(label, unit)| Output {
            label: label.to_owned(),
            unit,
            of: Vec::new(),
            parts: vec![0],
        });
        outputs.collect()
    }

    fn count(&self, _metric: &Metric, sums: &IntrinsicSums) -> u64 {
        sums.frames()
    }

    fn invalid(&self, sums: &IntrinsicSums) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, _metric: &Metric, output: &Output, sums: &IntrinsicSums) -> Numbers {
        let intervals = || Intervals::of(sums);
        match output.label.as_str() {
            "frame_rate" => Numbers::of(intervals().and_then(|intervals| intervals.frame_rate())),
            "jitter" => Numbers::of(intervals().and_then(|intervals| intervals.jitter())),
            "dropped" => Numbers::of(intervals().map(|intervals| intervals.dropped())),
            "duplicated" => Numbers::of(sums.duplicated()),
            "field_of_view" => {
                let extent = |axis| sums.extent(axis);
                Numbers::of(sums.field_of_view())
                    .with("width", Unit::Millimetre, Range::NotNegative, extent(0))
                    .with("height", Unit::Millimetre, Range::NotNegative, extent(1))
            }
            _ => {
                let sides = self
                    .frame_size
                    .ok_or(UndefinedReason::NotDeclared("frame_size"));
                let side = |at: usize| sides.map(|sides| f64::from(sides[at]));
                Numbers::of(self.resolution())
                    .with("width", Unit::Pixel, Range::NotNegative, side(0))
                    .with("height", Unit::Pixel, Range::NotNegative, side(1))
            }
        }
    }

    fn unclustered(&self) -> UndefinedReason {
        UndefinedReason::NoInterval
    }

    fn details(&self, _metric: &Metric, output: &Output, parts: &[&IntrinsicSums]) -> Details {
        let contacts = parts.iter().map(|sums| sums.contacts()).min();
        let counts = (output.label == "field_of_view").then(|| Count {
            name: "contacts",
            value: contacts.unwrap_or_default(),
        });
        Details {
            counts: counts.into_iter().collect(),
            ..Details::default()
        }
    }
}
