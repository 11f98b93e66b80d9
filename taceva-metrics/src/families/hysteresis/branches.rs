//! Sums of the presses at one contact point.

use std::sync::OnceLock;

use taceva_core::Phase;

use super::press::Press;
use crate::exact::merge::{Merge, keyed};
use crate::exact::number_key::Ordered;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::exact::{Dyadic, ExactSum};
use crate::pair::is_valid;
use crate::score::value::UndefinedReason;

/// Forces by depth during loading and unloading, the place of the contact point, and the cached comparison of both branches.
#[derive(Clone, Debug, Default)]
pub(super) struct Branches {
    load: Branch,
    unload: Branch,
    place: PlaceSums,
    press: OnceLock<Result<Press, UndefinedReason>>,
}

/// Number and exact sum of the forces at each depth.
type Branch = SortedMap<Ordered, (u64, ExactSum)>;

/// Number of samples and exact sums of their x and y, mm.
#[derive(Clone, Debug, Default, PartialEq)]
struct PlaceSums {
    n: u64,
    sums: [ExactSum; 2],
}

impl Branches {
    /// Adds a sample with depth in mm and force in N, both finite with magnitudes up to 2¹⁰²¹.
    pub(super) fn add(&mut self, phase: Phase, depth_mm: f64, force_n: f64) {
        self.press = OnceLock::new();
        let branch = match phase {
            Phase::Load => &mut self.load,
            Phase::Unload => &mut self.unload,
        };
        let (count, forces) = branch.entry(Ordered::new(depth_mm));
        *count += 1;
        forces.add(force_n);
    }

    /// Adds the place of a sample, mm.
    pub(super) fn add_place(&mut self, place_mm: [f64; 2]) {
        self.place.n += 1;
        for (sum, place) in self.place.sums.iter_mut().zip(place_mm) {
            sum.add(place);
        }
    }

    /// Comparison of the loading with the unloading branch, cached until samples are added.
    pub(super) fn press(&self) -> Result<Press, UndefinedReason> {
        *self
            .press
            .get_or_init(|| Press::compare(&corners(&self.load), &corners(&self.unload)))
    }

    /// Mean place of the samples, mm, rounded once; `None` if no sample has a place.
    pub(super) fn place_mm(&self) -> Option<[f64; 2]> {
        let PlaceSums { n, sums } = &self.place;
        let mean = |axis: usize| sums[axis].to_dyadic().over(&Dyadic::from(*n));
        (*n > 0).then(|| [mean(0), mean(1)])
    }

    /// Converts the sums to a record for a saved state.
    pub(super) fn to_record(&self) -> Record {
        let branch = |name: &str, branch: &Branch| {
            let record = Record {
                counts: branch.values().map(|(count, _)| *count).collect(),
                sums: branch.values().map(|(_, forces)| forces.clone()).collect(),
                values: branch.iter().map(|(depth, _)| depth.value()).collect(),
                ..Record::default()
            };
            (!branch.is_empty()).then(|| (name.to_owned(), record))
        };
        let branches = [
            branch(Phase::Load.name(), &self.load),
            branch(Phase::Unload.name(), &self.unload),
        ];
        Record {
            counts: vec![self.place.n],
            sums: self.place.sums.to_vec(),
            cells: keyed(branches.into_iter().flatten()),
            ..Record::default()
        }
    }

    /// Reads the sums from a record of a saved state.
    pub(super) fn read_record(record: &Record) -> Result<Branches, String> {
        let (&[n], sums) = record.with_cells()?;
        let branches = record.read_cells(Phase::from_name, read_branch)?;
        let branch = |phase| branches.get(&phase).cloned().unwrap_or_default();
        Ok(Branches {
            load: branch(Phase::Load),
            unload: branch(Phase::Unload),
            place: PlaceSums {
                n,
                sums: sums.clone(),
            },
            press: OnceLock::new(),
        })
    }
}

impl PartialEq for Branches {
    fn eq(&self, other: &Branches) -> bool {
        (&self.load, &self.unload, &self.place) == (&other.load, &other.unload, &other.place)
    }
}

impl Merge for Branches {
    fn merge(&mut self, other: &Branches) {
        self.press = OnceLock::new();
        for (ours, theirs) in [
            (&mut self.load, &other.load),
            (&mut self.unload, &other.unload),
        ] {
            for (depth, (n, forces)) in theirs {
                let (count, sum) = ours.entry(*depth);
                *count = count.saturating_add(*n);
                sum.merge(forces);
            }
        }
        self.place.n = self.place.n.saturating_add(other.place.n);
        self.place.sums.merge(&other.place.sums);
    }
}

/// Points `[depth in mm, mean force in N]` of a branch, depths ascending. Each mean is rounded once.
fn corners(branch: &Branch) -> Vec<[f64; 2]> {
    let mean = |count: &u64, forces: &ExactSum| forces.to_dyadic().over(&Dyadic::from(*count));
    let corners = branch.iter();
    corners
        .map(|(depth, (count, forces))| [depth.value(), mean(count, forces)])
        .collect()
}

fn read_branch(record: &Record) -> Result<Branch, String> {
    let depths = &record.values;
    let sound = depths.iter().all(|depth| is_valid(*depth))
        && depths.windows(2).all(|pair| pair[0] < pair[1])
        && !record.counts.contains(&0)
        && record.cells.is_empty();
    if !sound || record.counts.len() != depths.len() || record.sums.len() != depths.len() {
        return Err("invalid depths of a branch, expected ascending depths, each with a count and a sum of forces".to_owned());
    }
    let mut branch = Branch::default();
    for (row, depth) in depths.iter().enumerate() {
        branch.insert(
            Ordered::new(*depth),
            (record.counts[row], record.sums[row].clone()),
        );
    }
    Ok(branch)
}
