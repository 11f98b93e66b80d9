//! Area between the loading and the unloading branch of a press, split at crossings.

use std::cmp::Ordering;

use crate::exact::single::{exactly, magnitude, sign};
use crate::exact::{Dyadic, ExactSum};
use crate::score::value::UndefinedReason;

/// Force over depth of one branch: at least two points `[depth in mm, force in N]`, depths strictly ascending.
pub(crate) type Branch<'a> = &'a [[f64; 2]];

/// Comparison of the loading with the unloading branch of one press.
///
/// The area between two neighbouring depths is a rational number, rounded once. These areas are summed exactly. Unsigned areas have a relative
/// error of at most 2⁻⁵². The signed area is within 2⁻⁵³ of the unsigned area, plus one rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Press {
    /// ∫ |F_load − F_unload| dz over the depths that both branches reach, N mm.
    pub(crate) area: f64,
    /// ∫ (F_load − F_unload) dz, N mm; negative if the gel pushes harder during unloading.
    pub(crate) signed_area: f64,
    /// ∫ F_load dz over the depths that both branches reach, N mm.
    pub(crate) work: f64,
    /// Greatest |F_load − F_unload| over the depths that both branches reach, N.
    pub(crate) greatest_difference: f64,
    /// Greatest |F_load| over the whole loading branch, N.
    pub(crate) full_scale: f64,
}

impl Press {
    /// Compares the loading with the unloading branch. The force is linear between the points of a branch.
    ///
    /// # Errors
    /// [`UndefinedReason::ShortBranch`] for a branch with fewer than two depths, [`UndefinedReason::NoOverlap`] if the branches have no range of
    /// depths in common.
    pub(crate) fn compare(load: Branch<'_>, unload: Branch<'_>) -> Result<Press, UndefinedReason> {
        if load.len() < 2 || unload.len() < 2 {
            return Err(UndefinedReason::ShortBranch);
        }
        let grid = common_grid(load, unload)?;
        let (mut area, mut signed_area) = (ExactSum::default(), ExactSum::default());
        let mut work = ExactSum::default();
        let mut greatest_difference = 0.0_f64;
        for depths in grid.windows(2) {
            let stretch = Stretch::new(load, unload, [depths[0], depths[1]]);
            area.add(finite(stretch.area())?);
            signed_area.add(finite(stretch.signed_area())?);
            work.add(finite(stretch.work())?);
            greatest_difference = greatest_difference.max(stretch.greatest_difference());
        }
        let forces = load.iter().map(|[_, force]| force.abs());
        Ok(Press {
            area: area.to_f64(),
            signed_area: signed_area.to_f64(),
            work: work.to_f64(),
            greatest_difference: finite(greatest_difference)?,
            full_scale: forces.fold(0.0, f64::max),
        })
    }

    /// Share of the work of loading that is lost; `None` unless the work is above 0.
    pub(crate) fn ratio(&self) -> Option<f64> {
        (self.work > 0.0).then(|| self.area / self.work)
    }

    /// Greatest difference of the branches, as a share of `full_scale`; `None` if all forces of loading are 0.
    pub(crate) fn relative_difference(&self) -> Option<f64> {
        (self.full_scale > 0.0).then(|| self.greatest_difference / self.full_scale)
    }
}

/// Depths of both branches within their common range, ascending.
fn common_grid(load: Branch<'_>, unload: Branch<'_>) -> Result<Vec<f64>, UndefinedReason> {
    let start = load[0][0].max(unload[0][0]);
    let end = load[load.len() - 1][0].min(unload[unload.len() - 1][0]);
    if start >= end {
        return Err(UndefinedReason::NoOverlap);
    }
    let depths = load.iter().chain(unload).map(|[depth, _]| *depth);
    let mut grid: Vec<f64> = depths
        .filter(|depth| (start..=end).contains(depth))
        .collect();
    grid.sort_unstable_by(f64::total_cmp);
    grid.dedup_by(|one, other| one.total_cmp(other) == Ordering::Equal);
    Ok(grid)
}

/// A range of depths within which both branches are straight.
struct Stretch {
    /// Length of the range of depths, mm.
    width: Dyadic,
    /// Force of loading at both ends of the range, multiplied by `load_scale`.
    load: [Dyadic; 2],
    load_scale: Dyadic,
    /// Force of loading minus force of unloading at both ends of the range, multiplied by `scale`.
    difference: [Dyadic; 2],
    scale: Dyadic,
}

impl Stretch {
    fn new(load: Branch<'_>, unload: Branch<'_>, depths: [f64; 2]) -> Stretch {
        let (load, unload) = (Chord::over(load, depths), Chord::over(unload, depths));
        let difference = |end: usize| {
            &(&load.forces[end] * &unload.scale) - &(&unload.forces[end] * &load.scale)
        };
        Stretch {
            width: &exactly(depths[1]) - &exactly(depths[0]),
            difference: [difference(0), difference(1)],
            scale: &load.scale * &unload.scale,
            load: load.forces,
            load_scale: load.scale,
        }
    }

    /// ∫ |F_load − F_unload| dz over the range: (|u| + |v|) h / 2, or (u² + v²) h / (2 (|u| + |v|)) if the branches cross.
    ///
    /// The differences at the ends are u and v, and the width is h.
    fn area(&self) -> f64 {
        let [u, v] = &self.difference;
        let sizes = &magnitude(u.clone()) + &magnitude(v.clone());
        let crossing = sign(u) == sign(v).reverse() && sign(u) != Ordering::Equal;
        if crossing {
            let squares = &(u * u) + &(v * v);
            (&squares * &self.width).over(&(&twice(&self.scale) * &sizes))
        } else {
            (&sizes * &self.width).over(&twice(&self.scale))
        }
    }

    /// ∫ (F_load − F_unload) dz over the range: the mean of the differences at both ends, times the width.
    fn signed_area(&self) -> f64 {
        let [u, v] = &self.difference;
        (&(u + v) * &self.width).over(&twice(&self.scale))
    }

    /// ∫ F_load dz over the range: the mean of F_load at both ends, times the width.
    fn work(&self) -> f64 {
        let [start, end] = &self.load;
        (&(start + end) * &self.width).over(&twice(&self.load_scale))
    }

    /// Greatest |F_load − F_unload|. A difference of straight lines is greatest at an end.
    fn greatest_difference(&self) -> f64 {
        let ends = self
            .difference
            .iter()
            .map(|end| end.over(&self.scale).abs());
        ends.fold(0.0, f64::max)
    }
}

/// Straight piece of a branch, with the forces at both ends of a range of depths.
struct Chord {
    /// Forces at both ends of the range, multiplied by `scale`.
    forces: [Dyadic; 2],
    /// Difference in depth between the end points of the straight piece.
    scale: Dyadic,
}

impl Chord {
    fn over(branch: Branch<'_>, depths: [f64; 2]) -> Chord {
        let after = branch.partition_point(|[depth, _]| *depth <= depths[0]);
        let [[start, start_force], [end, end_force]] = [branch[after - 1], branch[after]];
        let [start, end, start_force, end_force] =
            [start, end, start_force, end_force].map(exactly);
        let force = |depth: f64| {
            let depth = exactly(depth);
            &(&start_force * &(&end - &depth)) + &(&end_force * &(&depth - &start))
        };
        Chord {
            forces: depths.map(force),
            scale: &end - &start,
        }
    }
}

fn twice(value: &Dyadic) -> Dyadic {
    value + value
}

fn finite(value: f64) -> Result<f64, UndefinedReason> {
    value
        .is_finite()
        .then_some(value)
        .ok_or(UndefinedReason::Overflow)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compare(load: Branch<'_>, unload: Branch<'_>) -> Press {
        Press::compare(load, unload).expect("common depths")
    }

    #[test]
    fn equal_branches_enclose_nothing() {
        let branch = [[0.0, 0.0], [0.1, 0.3], [0.7, 1.1]];
        let press = compare(&branch, &branch);
        assert_eq!((press.area, press.signed_area), (0.0, 0.0));
        assert_eq!(press.ratio(), Some(0.0));
    }

    #[test]
    fn a_crossing_within_a_stretch_is_split_where_it_is() {
        // u = −0.25 at 0, v = 0.5 at 1: triangles of 1/24 and 1/6.
        let press = compare(&[[0.0, 0.0], [1.0, 1.0]], &[[0.0, 0.25], [1.0, 0.5]]);
        assert_eq!(press.area.to_bits(), (5.0_f64 / 24.0).to_bits());
        assert_eq!(press.signed_area.to_bits(), 0.125_f64.to_bits());
        assert_eq!(press.relative_difference(), Some(0.5));
    }

    #[test]
    fn branches_that_share_no_stretch_of_depths_are_not_compared() {
        let (shallow, deep) = ([[0.0, 0.0], [0.2, 0.1]], [[0.2, 0.4], [1.0, 1.0]]);
        assert_eq!(
            Press::compare(&shallow, &deep),
            Err(UndefinedReason::NoOverlap)
        );
        assert_eq!(
            Press::compare(&shallow, &deep[..1]),
            Err(UndefinedReason::ShortBranch)
        );
    }

    #[test]
    fn a_press_without_force_has_no_relative_values() {
        let idle = [[0.0, 0.0], [1.0, 0.0]];
        let press = compare(&idle, &[[0.0, 0.1], [1.0, 0.0]]);
        assert_eq!((press.ratio(), press.relative_difference()), (None, None));
    }

    #[test]
    fn forces_beyond_all_measure_overflow_by_name() {
        let press = Press::compare(&[[0.0, 1e300], [1e300, 1e300]], &[[0.0, 0.0], [1e300, 0.0]]);
        assert_eq!(press, Err(UndefinedReason::Overflow));
    }
}
