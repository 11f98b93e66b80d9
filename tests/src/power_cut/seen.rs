//! Set of states that were already checked.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use super::model::{Bytes, Disk, Object};
use super::operation::{ObjectId, ROOT};
use super::remains::Picked;
use super::tree::{Tree, joined};

/// States seen so far. Contents are numbered, so that a state has a short key.
#[derive(Default)]
pub(super) struct Seen {
    numbers: HashMap<Arc<Bytes>, (usize, Arc<Bytes>)>,
    states: HashSet<(usize, Vec<(String, usize)>)>,
    of_durable: BTreeMap<ObjectId, (Arc<Bytes>, usize)>,
}

/// Number that stands for a folder in the key of a state.
const FOLDER: usize = usize::MAX;

impl Seen {
    /// Tree of the combination `picked`; `None` if this tree was seen before with the same printed lines.
    pub(super) fn new_tree(&mut self, disk: &Disk, picked: &Picked<'_>) -> Option<Tree> {
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

    /// Like [`number`](Seen::number), for a durable file. Stores the number with the bytes, so that an unchanged file is not looked up again.
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
