//! Every state that a power cut could leave.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::model::{ByteChange, Bytes};
use super::model::{Disk, Layered, Names, Object, ObjectId, ROOT, Tree, joined, write_tree};
use super::trace::Trace;
use crate::random::Random;

/// Where the last write of a file may be torn: within a sector, at its edges, at those of a page; beside these in its middle
/// and before its last byte.
const TEARS: [usize; 5] = [1, 511, 512, 4096, 4097];
/// Up to this many changes of one file, every subset of them is tried; beyond, prefixes and drawn subsets.
const ALL_SUBSETS_UP_TO: usize = 5;
const DRAWN_SUBSETS: usize = 24;
/// Combinations of one cut that are tried one by one; beyond, that many are drawn and the cut is reported.
const COMBINATIONS: usize = 20_000;

/// What one power cut left.
#[derive(Debug)]
pub struct State<'a> {
    /// Operations before the cut.
    pub cut: usize,
    /// Lines the program had printed by then.
    pub printed: &'a [String],
    /// What is found after the restart.
    pub tree: &'a Tree,
}

impl State<'_> {
    /// Puts the state into the folder at `path`, which must be empty.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write_to(&self, path: &Path) -> std::io::Result<()> {
        write_tree(self.tree, path)
    }

    /// The bytes of a file.
    pub fn file(&self, path: &str) -> Option<&[u8]> {
        Some(self.tree.get(path)?.as_ref()?.as_slice())
    }

    /// The highest number among the printed lines `ACK n`; 0 without one.
    pub fn acknowledged(&self) -> usize {
        self.printed
            .iter()
            .filter_map(|line| line.strip_prefix("ACK ")?.parse().ok())
            .max()
            .unwrap_or(0)
    }
}

/// What came of trying all states.
#[derive(Debug, Default)]
pub struct Tally {
    /// Moments at which power was cut.
    pub cuts: usize,
    /// Different states, those that two cuts share counted once.
    pub states: usize,
    /// Cuts with more combinations than were tried.
    pub capped: usize,
    /// States in which the promise was broken.
    pub violations: usize,
    /// The first of them: at which operation, and how.
    pub first: Option<String>,
}

impl Tally {
    /// Both together.
    #[must_use]
    pub fn and(self, other: Tally) -> Tally {
        Tally {
            cuts: self.cuts + other.cuts,
            states: self.states + other.states,
            capped: self.capped + other.capped,
            violations: self.violations + other.violations,
            first: self.first.or(other.first),
        }
    }
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Tally {
            cuts,
            states,
            capped,
            violations,
            first,
        } = self;
        write!(f, "{cuts} cuts, {states} states, {violations} violations")?;
        if *capped > 0 {
            write!(f, ", {capped} cuts not in full")?;
        }
        match first {
            Some(first) => write!(f, "; first: {first}"),
            None => Ok(()),
        }
    }
}

impl Trace {
    /// Calls `check` with every state that a cut after `cuts` operations could leave; its error is a broken promise.
    pub fn each_state(
        &self,
        cuts: Range<usize>,
        mut check: impl FnMut(&State<'_>) -> Result<(), String>,
    ) -> Tally {
        let mut disk = self.after(cuts.start);
        let mut seen = Seen::default();
        let mut tally = Tally::default();
        for cut in cuts {
            tally.cuts += 1;
            let choices = Choices::of(&disk, cut);
            tally.capped += usize::from(choices.is_capped());
            choices.each(|picked| {
                let Some(tree) = seen.new_tree(&disk, picked) else {
                    return;
                };
                tally.states += 1;
                let state = State {
                    cut,
                    printed: disk.printed(),
                    tree: &tree,
                };
                if let Err(problem) = check(&state) {
                    tally.violations += 1;
                    tally.first.get_or_insert_with(|| {
                        let last = cut.checked_sub(1).map(|last| short(&self.operations[last]));
                        format!(
                            "after operation {cut} ({}): {problem}",
                            last.unwrap_or_default()
                        )
                    });
                }
            });
            if let Some(operation) = self.operations.get(cut) {
                disk.apply(operation);
            }
        }
        tally
    }
}

/// Enough of an operation to find it in the trace.
fn short(operation: &super::Operation) -> String {
    let text = format!("{operation:?}");
    text.chars().take(120).collect()
}

/// What an object that is not wholly durable may turn out to be.
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

/// One of the [`Remains`] for each of the objects that are not wholly durable.
struct Picked<'a> {
    choices: &'a Choices,
    positions: &'a [usize],
}

impl Picked<'_> {
    fn bytes(&self, id: ObjectId) -> Option<&Arc<Bytes>> {
        let place = *self.choices.place_of.get(&id)?;
        match &self.choices.remains[place] {
            Remains::Bytes(remains) => remains.get(self.positions[place]),
            Remains::Names(_) => None,
        }
    }

    fn names(&self, id: ObjectId) -> Option<&Names> {
        let place = *self.choices.place_of.get(&id)?;
        match &self.choices.remains[place] {
            Remains::Names(remains) => remains.get(self.positions[place]),
            Remains::Bytes(_) => None,
        }
    }
}

/// Everything that is open at one cut.
struct Choices {
    remains: Vec<Remains>,
    place_of: HashMap<ObjectId, usize>,
    random: Random,
}

impl Choices {
    fn of(disk: &Disk, cut: usize) -> Choices {
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

    /// Combinations, if they can be counted.
    fn count(&self) -> Option<usize> {
        self.remains
            .iter()
            .try_fold(1_usize, |count, remains| count.checked_mul(remains.len()))
    }

    fn is_capped(&self) -> bool {
        self.count().is_none_or(|count| count > COMBINATIONS)
    }

    fn each(&self, mut visit: impl FnMut(&Picked<'_>)) {
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
            let mut random = self.random;
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
            // Counts up as an odometer does.
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

/// What may be found of a file: any subset of its changes, the last one torn, the part behind the tear missing or zero.
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
            // The length is there and no byte is.
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

/// The states met so far: contents are numbered, so that a state is known by a short key.
#[derive(Default)]
struct Seen {
    numbers: HashMap<Arc<Bytes>, (usize, Arc<Bytes>)>,
    states: HashSet<(usize, Vec<(String, usize)>)>,
    of_durable: BTreeMap<ObjectId, (Arc<Bytes>, usize)>,
}

/// The number of what is no file.
const FOLDER: usize = usize::MAX;

impl Seen {
    /// The tree of a combination, unless it was met before with the same lines printed.
    fn new_tree(&mut self, disk: &Disk, picked: &Picked<'_>) -> Option<Tree> {
        let mut tree = Tree::new();
        let mut key = Vec::new();
        self.add(disk, picked, ROOT, "", &mut tree, &mut key);
        self.states
            .insert((disk.printed().len(), key))
            .then_some(tree)
    }

    fn add(
        &mut self,
        disk: &Disk,
        picked: &Picked<'_>,
        id: ObjectId,
        prefix: &str,
        tree: &mut Tree,
        key: &mut Vec<(String, usize)>,
    ) {
        let Object::Folder(folder) = &disk.objects[id] else {
            return;
        };
        for (name, child) in picked.names(id).unwrap_or(&folder.durable) {
            let path = joined(prefix, name);
            match &disk.objects[*child] {
                Object::Folder(_) => {
                    key.push((path.clone(), FOLDER));
                    tree.insert(path.clone(), None);
                    self.add(disk, picked, *child, &path, tree, key);
                }
                Object::File(file) => {
                    let (number, bytes) = match picked.bytes(*child) {
                        Some(bytes) => self.number(bytes),
                        None => self.number_durable(*child, &file.durable),
                    };
                    key.push((path.clone(), number));
                    tree.insert(path, Some(bytes));
                }
            }
        }
    }

    fn number(&mut self, bytes: &Arc<Bytes>) -> (usize, Arc<Bytes>) {
        let next = self.numbers.len();
        self.numbers
            .entry(Arc::clone(bytes))
            .or_insert_with(|| (next, Arc::clone(bytes)))
            .clone()
    }

    /// As [`number`](Seen::number), remembering which bytes a durable file had last.
    fn number_durable(&mut self, id: ObjectId, bytes: &Bytes) -> (usize, Arc<Bytes>) {
        if let Some((known, number)) = self.of_durable.get(&id)
            && **known == *bytes
        {
            return (*number, Arc::clone(known));
        }
        let (number, shared) = self.number(&Arc::new(bytes.clone()));
        self.of_durable.insert(id, (Arc::clone(&shared), number));
        (number, shared)
    }
}
