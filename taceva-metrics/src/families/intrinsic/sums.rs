//! Frames of a recording, and the convex hull of the places of contact.

use crate::exact::Dyadic;
use crate::exact::merge::{Merge, keyed};
use crate::exact::number_key::Ordered;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::geometry::{GrowingHull, Hull};
use crate::pair::is_valid;
use crate::score::value::{Finished, UndefinedReason};
use taceva_core::random::fnv_1a;

/// Times and digests of all frames, and the convex hull of the places of contact.
///
/// The frames form a set: a frame in several samples counts once. A digest is shortened to eight bytes, which suffice to compare neighbouring
/// frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct IntrinsicSums {
    n_invalid: u64,
    /// Number of samples with a time.
    timed: u64,
    /// Number of samples that are in contact and have a place.
    contacts: u64,
    hull: GrowingHull,
    frames: SortedMap<(Ordered, Option<u64>), ()>,
}

impl IntrinsicSums {
    /// Adds a frame with its time in s and the digest of its bytes.
    pub(super) fn add_time(&mut self, time_s: f64, digest: Option<&str>) {
        if is_valid(time_s) {
            let digest = digest.map(|digest| fnv_1a(digest.as_bytes()));
            self.frames.insert((Ordered::new(time_s), digest), ());
            self.timed += 1;
        } else {
            self.n_invalid += 1;
        }
    }

    /// Adds places of contact, x and y in mm.
    pub(super) fn add_contacts(&mut self, places_mm: &[[f64; 2]]) {
        let valid = |place: &&[f64; 2]| place.iter().all(|value| is_valid(*value));
        for place in places_mm {
            if valid(&place) {
                self.contacts += 1;
            } else {
                self.n_invalid += 1;
            }
        }
        self.hull.extend(places_mm.iter().filter(valid).copied());
    }

    /// Distinct times in s, ascending.
    pub(super) fn times_s(&self) -> Vec<f64> {
        let mut times: Vec<Ordered> = self.frames.iter().map(|((time, _), ())| *time).collect();
        times.dedup();
        times.into_iter().map(Ordered::value).collect()
    }

    /// Number of different frames.
    pub(super) fn frames(&self) -> u64 {
        self.frames.iter().fold(0, |count, _| count + 1)
    }

    /// Number of samples with a time.
    pub(super) fn timed(&self) -> u64 {
        self.timed
    }

    /// Number of samples that are in contact and have a place.
    pub(super) fn contacts(&self) -> u64 {
        self.contacts
    }

    /// Number of samples skipped for a NaN or a magnitude above 2¹⁰²¹.
    pub(super) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// Share of frames with the digest of the previous frame, over the frames for which both digests are known.
    pub(super) fn duplicated(&self) -> Finished {
        if self.frames.is_empty() {
            return Err(UndefinedReason::NoTimes);
        }
        let (mut followers, mut duplicates) = (0_u64, 0_u64);
        let mut before = None;
        for ((_, after), ()) in &self.frames {
            if before.is_some() && after.is_some() {
                followers += 1;
                duplicates += u64::from(before == *after);
            }
            before = *after;
        }
        if followers == 0 {
            return Err(UndefinedReason::NoDigests);
        }
        Ok(Dyadic::from(duplicates).over(&Dyadic::from(followers)))
    }

    /// Area of the convex hull of the places of contact, mm², rounded once.
    pub(super) fn field_of_view(&self) -> Finished {
        if self.hull.hull().is_empty() {
            return Err(UndefinedReason::NoContact);
        }
        Ok(self.hull.hull().area())
    }

    /// Width (axis 0) or height (axis 1) of the convex hull of the places of contact, mm.
    pub(super) fn extent(&self, axis: usize) -> Finished {
        let extent = self
            .hull
            .hull()
            .extent(axis)
            .ok_or(UndefinedReason::NoContact)?;
        Ok(extent[1] - extent[0])
    }

    /// Converts the sums to a record for a saved state: the corners of the hull, and one record each for frames with and without a digest.
    pub(super) fn to_record(&self) -> Record {
        let part = |of: &dyn Fn(&Option<u64>) -> bool| {
            let frames = self.frames.iter().filter(|((_, digest), ())| of(digest));
            let (values, digests): (Vec<f64>, Vec<Option<u64>>) = frames
                .map(|((time, digest), ())| (time.value(), *digest))
                .unzip();
            Record {
                counts: digests.into_iter().flatten().collect(),
                values,
                ..Record::default()
            }
        };
        let parts = [
            (PLAIN, part(&|digest| digest.is_none())),
            (DIGESTED, part(&|digest| digest.is_some())),
        ];
        let parts = parts
            .into_iter()
            .filter(|(_, part)| !part.values.is_empty());
        Record {
            counts: vec![self.n_invalid, self.timed, self.contacts],
            values: self.hull.hull().corners().concat(),
            cells: keyed(parts.map(|(name, part)| (name.to_owned(), part))),
            ..Record::default()
        }
    }

    /// Reads the sums from a record of a saved state.
    pub(super) fn read_record(record: &Record) -> Result<IntrinsicSums, String> {
        let (&[n_invalid, timed, contacts], []) = record.with_cells()?;
        let hull = Hull::from_values(&record.values)?;
        let known = |name: &str| [PLAIN, DIGESTED].into_iter().find(|known| *known == name);
        let parts = record.read_cells(known, |record| Ok(record.clone()))?;
        let mut frames = SortedMap::default();
        for (&name, part) in &parts {
            let digests = if name == PLAIN { 0 } else { part.values.len() };
            let whole = part.counts.len() == digests
                && part.sums.is_empty()
                && part.cells.is_empty()
                && part.values.iter().all(|time| is_valid(*time));
            if !whole {
                return Err(format!("frames `{name}`: expected times with digests"));
            }
            for (row, time) in part.values.iter().enumerate() {
                let digest = part.counts.get(row).copied();
                frames.insert((Ordered::new(*time), digest), ());
            }
        }
        Ok(IntrinsicSums {
            n_invalid,
            timed,
            contacts,
            hull: hull.into(),
            frames,
        })
    }
}

/// Name of the record for frames without a digest.
const PLAIN: &str = "plain";
/// Name of the record for frames with a digest.
const DIGESTED: &str = "digested";

impl Merge for IntrinsicSums {
    fn merge(&mut self, other: &IntrinsicSums) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.timed = self.timed.saturating_add(other.timed);
        self.contacts = self.contacts.saturating_add(other.contacts);
        self.hull.merge(other.hull.hull());
        for (frame, ()) in &other.frames {
            self.frames.insert(*frame, ());
        }
    }
}
