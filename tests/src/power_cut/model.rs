//! Model of a disk at a power cut: durable changes, and pending ones.
//!
//! A file and its name are separate. Syncing a file makes its bytes durable, but not its name. Syncing a folder makes its names durable,
//! but not the bytes of the files. Names of one folder become durable in the order of their creation. There is no order between folders and
//! between files.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::operation::{Kind, ObjectId, Operation, ROOT};
use super::tree::{Tree, joined};

/// A change of a file that is not durable yet.
#[derive(Clone, Debug)]
pub(super) enum ByteChange {
    Write { offset: usize, bytes: Vec<u8> },
    Resize(usize),
}

/// A change of the names in a folder: a removed name, added names, or both at once.
#[derive(Clone, Debug)]
pub(super) struct NameChange {
    pub(super) gone: Option<String>,
    pub(super) come: Vec<(String, ObjectId)>,
}

/// A partly durable object: its durable state, its current state, and the changes in between, oldest first.
#[derive(Clone, Debug)]
pub(super) struct Layered<T, C> {
    pub(super) durable: T,
    pub(super) live: T,
    pub(super) pending: Vec<(usize, C)>,
}

pub(super) type Bytes = Vec<u8>;
pub(super) type Names = BTreeMap<String, ObjectId>;

#[derive(Clone, Debug)]
pub(super) enum Object {
    File(Layered<Bytes, ByteChange>),
    Folder(Layered<Names, NameChange>),
}

/// A watched folder with its content, and the lines that the program has printed.
#[derive(Clone, Debug)]
pub struct Disk {
    pub(super) objects: Vec<Object>,
    printed: Vec<String>,
    applied: usize,
}

impl Disk {
    /// Loads the folder at `path`, all of it durable.
    ///
    /// # Errors
    /// Errors of reading the folder.
    pub fn load(path: &Path) -> std::io::Result<Disk> {
        let mut disk = Disk {
            objects: vec![Object::Folder(Layered::settled(Names::new()))],
            printed: Vec::new(),
            applied: 0,
        };
        disk.load_folder(path, ROOT)?;
        Ok(disk)
    }

    fn load_folder(&mut self, path: &Path, id: ObjectId) -> std::io::Result<()> {
        let mut names = Names::new();
        for entry in std::fs::read_dir(path)? {
            let entry = entry?;
            let child = self.objects.len();
            if entry.file_type()?.is_dir() {
                self.objects
                    .push(Object::Folder(Layered::settled(Names::new())));
                self.load_folder(&entry.path(), child)?;
            } else {
                let bytes = std::fs::read(entry.path())?;
                self.objects.push(Object::File(Layered::settled(bytes)));
            }
            names.insert(entry.file_name().to_string_lossy().into_owned(), child);
        }
        self.objects[id] = Object::Folder(Layered::settled(names));
        Ok(())
    }

    /// Lines that the program has printed so far.
    pub fn printed(&self) -> &[String] {
        &self.printed
    }

    /// Number of operations applied so far.
    pub fn applied(&self) -> usize {
        self.applied
    }

    /// Object of `name` in `folder`, as programs see it; `None` if the name is free.
    pub fn lookup(&self, folder: ObjectId, name: &str) -> Option<ObjectId> {
        match &self.objects[folder] {
            Object::Folder(folder) => folder.live.get(name).copied(),
            Object::File(_) => None,
        }
    }

    /// Length of a file, bytes, as programs see it.
    pub fn length(&self, id: ObjectId) -> usize {
        match &self.objects[id] {
            Object::File(file) => file.live.len(),
            Object::Folder(_) => 0,
        }
    }

    /// Next free object number.
    pub fn next_id(&self) -> ObjectId {
        self.objects.len()
    }

    /// Applies `operation` to the current state. A change becomes durable when a sync covers it.
    pub fn apply(&mut self, operation: &Operation) {
        match operation {
            Operation::Create { folder, name, kind } => {
                let id = self.objects.len();
                self.objects.push(match kind {
                    Kind::File => Object::File(Layered::settled(Bytes::new())),
                    Kind::Folder => Object::Folder(Layered::settled(Names::new())),
                });
                self.rename(*folder, None, Some((name.clone(), id)));
            }
            Operation::Link {
                folder,
                name,
                object,
            } => self.rename(*folder, None, Some((name.clone(), *object))),
            Operation::Remove { folder, name } => self.rename(*folder, Some(name.clone()), None),
            Operation::Rename { from, to } => self.move_name(from, to),
            Operation::Exchange { one, other } => self.exchange(one, other),
            Operation::Write {
                file,
                offset,
                bytes,
            } => self.change(
                *file,
                ByteChange::Write {
                    offset: *offset,
                    bytes: bytes.clone(),
                },
            ),
            Operation::Resize { file, length } => self.change(*file, ByteChange::Resize(*length)),
            Operation::Sync { object, covers } => self.sync(*object, *covers),
            Operation::Print(line) => self.printed.push(line.clone()),
        }
        self.applied += 1;
    }

    fn move_name(&mut self, from: &(ObjectId, String), to: &(ObjectId, String)) {
        let Some(object) = self.lookup(from.0, &from.1) else {
            return;
        };
        let come = Some((to.1.clone(), object));
        if from.0 == to.0 {
            self.rename(from.0, Some(from.1.clone()), come);
        } else {
            self.rename(to.0, None, come);
            self.rename(from.0, Some(from.1.clone()), None);
        }
    }

    /// Exchanges two names. The exchange is atomic within a folder, because its journal stores names. Between two folders, a cut may leave only one
    /// of the two changes.
    fn exchange(&mut self, one: &(ObjectId, String), other: &(ObjectId, String)) {
        let (Some(first), Some(second)) =
            (self.lookup(one.0, &one.1), self.lookup(other.0, &other.1))
        else {
            return;
        };
        let (one_now, other_now) = ((one.1.clone(), second), (other.1.clone(), first));
        if one.0 == other.0 {
            self.rename(one.0, None, [one_now, other_now]);
        } else {
            self.rename(one.0, None, [one_now]);
            self.rename(other.0, None, [other_now]);
        }
    }

    fn rename(
        &mut self,
        id: ObjectId,
        gone: Option<String>,
        come: impl IntoIterator<Item = (String, ObjectId)>,
    ) {
        let come = come.into_iter().collect();
        if let Object::Folder(folder) = &mut self.objects[id] {
            let change = NameChange { gone, come };
            change.apply(&mut folder.live);
            folder.pending.push((self.applied, change));
        }
    }

    fn change(&mut self, id: ObjectId, change: ByteChange) {
        if let Object::File(file) = &mut self.objects[id] {
            change.apply(&mut file.live);
            file.pending.push((self.applied, change));
        }
    }

    fn sync(&mut self, id: ObjectId, covers: usize) {
        match &mut self.objects[id] {
            Object::File(file) => file.settle(covers, ByteChange::apply),
            Object::Folder(folder) => folder.settle(covers, NameChange::apply),
        }
    }

    /// Content of the folder, as programs see it.
    pub fn live_tree(&self) -> Tree {
        let mut tree = Tree::new();
        self.add_live(ROOT, "", &mut tree);
        tree
    }

    fn add_live(&self, id: ObjectId, prefix: &str, tree: &mut Tree) {
        let Object::Folder(folder) = &self.objects[id] else {
            return;
        };
        for (name, child) in &folder.live {
            let path = joined(prefix, name);
            match &self.objects[*child] {
                Object::File(file) => {
                    tree.insert(path, Some(Arc::new(file.live.clone())));
                }
                Object::Folder(_) => {
                    self.add_live(*child, &path, tree);
                    tree.insert(path, None);
                }
            }
        }
    }
}

impl<T: Clone, C> Layered<T, C> {
    /// Creates a fully durable object with the content `value`.
    fn settled(value: T) -> Layered<T, C> {
        Layered {
            durable: value.clone(),
            live: value,
            pending: Vec::new(),
        }
    }

    /// Makes the changes of the first `covers` operations durable.
    fn settle(&mut self, covers: usize, apply: impl Fn(&C, &mut T)) {
        let kept = self.pending.partition_point(|(number, _)| *number < covers);
        for (_, change) in self.pending.drain(..kept) {
            apply(&change, &mut self.durable);
        }
    }
}

impl ByteChange {
    pub(super) fn apply(&self, bytes: &mut Bytes) {
        match self {
            ByteChange::Write {
                offset,
                bytes: written,
            } => {
                let end = offset + written.len();
                if bytes.len() < end {
                    bytes.resize(end, 0);
                }
                bytes[*offset..end].copy_from_slice(written);
            }
            ByteChange::Resize(length) => bytes.resize(*length, 0),
        }
    }
}

impl NameChange {
    pub(super) fn apply(&self, names: &mut Names) {
        if let Some(gone) = &self.gone {
            names.remove(gone);
        }
        for (name, id) in &self.come {
            names.insert(name.clone(), *id);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn create(name: &str) -> Operation {
        Operation::Create {
            folder: ROOT,
            name: name.to_owned(),
            kind: Kind::File,
        }
    }

    fn disk(operations: &[Operation]) -> Disk {
        let folder = tempfile::tempdir().expect("a folder");
        let mut disk = Disk::load(folder.path()).expect("empty");
        operations
            .iter()
            .for_each(|operation| disk.apply(operation));
        disk
    }

    #[test]
    fn a_durable_file_has_no_durable_name() {
        let write = Operation::Write {
            file: 1,
            offset: 0,
            bytes: b"x".to_vec(),
        };
        let sync = Operation::Sync {
            object: 1,
            covers: 2,
        };
        let disk = disk(&[create("a"), write, sync]);
        let Object::Folder(root) = &disk.objects[ROOT] else {
            panic!("the root is a folder")
        };
        assert!(root.durable.is_empty() && root.live.contains_key("a"));
        let Object::File(file) = &disk.objects[1] else {
            panic!("a file")
        };
        assert_eq!(
            (file.durable.as_slice(), file.pending.len()),
            (&b"x"[..], 0)
        );
    }

    #[test]
    fn what_was_written_after_a_sync_began_is_not_covered() {
        let write = |offset| Operation::Write {
            file: 1,
            offset,
            bytes: b"x".to_vec(),
        };
        let sync = Operation::Sync {
            object: 1,
            covers: 2,
        };
        let disk = disk(&[create("a"), write(0), write(1), sync]);
        let Object::File(file) = &disk.objects[1] else {
            panic!("a file")
        };
        assert_eq!((file.durable.len(), file.pending.len()), (1, 1));
    }
}
