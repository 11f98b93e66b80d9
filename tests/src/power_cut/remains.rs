//! Possible contents, after a power cut, of each object that is not fully durable, and all combinations of them.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::model::{ByteChange, Bytes, Disk, Layered, Names, Object};
use super::operation::ObjectId;
use crate::random::Random;

/// Numbers of bytes that remain of the last write of a file if a power cut tears it: within a sector, or near the end of a sector or page. Other
/// tears are in the middle and before the last byte.
const TEARS: [usize; 5] = [1, 511, 512, 4096, 4097];
/// Largest number of changes of a file for which every subset is tried. For more changes, prefixes and random subsets are tried.
const ALL_SUBSETS_UP_TO: usize = 5;
const DRAWN_SUBSETS: usize = 24;
/// Largest number of combinations at one power cut that are all tried. For more, this many are drawn and the cut is reported.
const COMBINATIONS: usize = 20_000;

/// Possible state of an object that is not fully durable.
enum Remains {
    Bytes(Vec<Arc<Bytes>>),
    Names(Vec<Names>),
}

impl Remains {
    fn len(&self) -> usize {
        match self {
            Remains::Bytes(remains) => remains.len(),
            Remains::Names(remains) => remains.len(),
        }
    }
}

/// A combination: one possible state for each object that is not fully durable.
pub(super) struct Picked<'a> {
    choices: &'a Choices,
    positions: &'a [usize],
}

impl Picked<'_> {
    pub(super) fn bytes(&self, id: ObjectId) -> Option<&Arc<Bytes>> {
        let place = *self.choices.place_of.get(&id)?;
        match &self.choices.remains[place] {
            Remains::Bytes(remains) => remains.get(self.positions[place]),
            Remains::Names(_) => None,
        }
    }

    pub(super) fn names(&self, id: ObjectId) -> Option<&Names> {
        let place = *self.choices.place_of.get(&id)?;
        match &self.choices.remains[place] {
            Remains::Names(remains) => remains.get(self.positions[place]),
            Remains::Bytes(_) => None,
        }
    }
}

/// Possible states of each object at one power cut.
pub(super) struct Choices {
    remains: Vec<Remains>,
    place_of: HashMap<ObjectId, usize>,
    random: Random,
}

impl Choices {
    pub(super) fn of(disk: &Disk, cut: usize) -> Choices {
        let mut random = Random::new(cut as u64);
        let mut choices = Choices {
            remains: Vec::new(),
            place_of: HashMap::new(),
            random: Random::new(!(cut as u64)),
        };
        for (id, object) in disk.objects.iter().enumerate() {
            let remains = match object {
                Object::File(file) if !file.pending.is_empty() => {
                    Remains::Bytes(possible_bytes(file, &mut random))
                }
                Object::Folder(folder) if !folder.pending.is_empty() => Remains::Names(
                    (0..=folder.pending.len())
                        .map(|kept| {
                            let mut names = folder.durable.clone();
                            let changes = &folder.pending[..kept];
                            changes
                                .iter()
                                .for_each(|(_, change)| change.apply(&mut names));
                            names
                        })
                        .collect(),
                ),
                _ => continue,
            };
            choices.place_of.insert(id, choices.remains.len());
            choices.remains.push(remains);
        }
        choices
    }

    /// Number of combinations; `None` if it overflows.
    fn count(&self) -> Option<usize> {
        self.remains
            .iter()
            .try_fold(1_usize, |count, remains| count.checked_mul(remains.len()))
    }

    pub(super) fn is_capped(&self) -> bool {
        self.count().is_none_or(|count| count > COMBINATIONS)
    }

    pub(super) fn each(&self, mut visit: impl FnMut(&Picked<'_>)) {
        let mut positions = vec![0; self.remains.len()];
        let mut visit = |positions: &[usize]| {
            visit(&Picked {
                choices: self,
                positions,
            });
        };
        if self.is_capped() {
            visit(&positions);
            let newest: Vec<usize> = self
                .remains
                .iter()
                .map(|remains| remains.len() - 1)
                .collect();
            visit(&newest);
            let mut random = self.random.clone();
            for _ in 0..COMBINATIONS {
                for (position, remains) in positions.iter_mut().zip(&self.remains) {
                    *position = random.below(remains.len());
                }
                visit(&positions);
            }
            return;
        }
        loop {
            visit(&positions);
            // Counts up like an odometer.
            let step = positions
                .iter()
                .zip(&self.remains)
                .position(|(position, remains)| position + 1 < remains.len());
            let Some(wheel) = step else {
                return;
            };
            positions[wheel] += 1;
            positions[..wheel].fill(0);
        }
    }
}

/// Possible contents of a file: the durable bytes with any subset of the later changes. The last change may be torn; the bytes after the tear are
/// then missing or zero.
fn possible_bytes(file: &Layered<Bytes, ByteChange>, random: &mut Random) -> Vec<Arc<Bytes>> {
    let mut found: HashSet<Bytes> = HashSet::from([file.durable.clone()]);
    for subset in subsets(file.pending.len(), random) {
        let kept: Vec<&ByteChange> = file
            .pending
            .iter()
            .zip(&subset)
            .filter(|(_, kept)| **kept)
            .map(|((_, change), _)| change)
            .collect();
        let Some((last, before)) = kept.split_last() else {
            continue;
        };
        let mut bytes = file.durable.clone();
        before.iter().for_each(|change| change.apply(&mut bytes));
        if let ByteChange::Write {
            offset,
            bytes: written,
        } = last
        {
            let own = [written.len() / 2, written.len().saturating_sub(1)];
            let tears = TEARS.into_iter().chain(own);
            for tear in tears.filter(|tear| *tear < written.len()) {
                let length = bytes.len();
                let mut torn = bytes.clone();
                let head = written[..tear].to_vec();
                ByteChange::Write {
                    offset: *offset,
                    bytes: head,
                }
                .apply(&mut torn);
                found.insert(torn.clone());
                torn.resize(length.max(offset + written.len()), 0);
                found.insert(torn);
            }
        }
        last.apply(&mut bytes);
        if let ByteChange::Write {
            offset,
            bytes: written,
        } = last
        {
            // The length is durable, but no byte is.
            let mut zeros = bytes.clone();
            let new = (*offset).max(file.durable.len()).min(zeros.len());
            zeros[new..(offset + written.len()).max(new)].fill(0);
            found.insert(zeros);
        }
        found.insert(bytes);
    }
    let mut ordered: Vec<Bytes> = found.into_iter().collect();
    ordered.sort();
    ordered.into_iter().map(Arc::new).collect()
}

fn subsets(count: usize, random: &mut Random) -> Vec<Vec<bool>> {
    if count <= ALL_SUBSETS_UP_TO {
        return (1..1_usize << count)
            .map(|mask| (0..count).map(|bit| mask >> bit & 1 == 1).collect())
            .collect();
    }
    let prefixes = (1..=count).map(|kept| (0..count).map(|change| change < kept).collect());
    let mut subsets: Vec<Vec<bool>> = prefixes.collect();
    subsets.extend((0..DRAWN_SUBSETS).map(|_| (0..count).map(|_| random.below(2) == 1).collect()));
    subsets
}
