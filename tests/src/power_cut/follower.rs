//! Conversion of system calls to operations: tracks the descriptors, offsets and names of the kernel, call by call.

use std::collections::HashMap;
use std::path::{Component, Path};

use super::model::Disk;
use super::operation::{Kind, ObjectId, Operation, ROOT};
use super::syscall::{Call, Lexer, bytes_of};

/// An open file, shared by duplicated descriptors.
#[derive(Clone, Copy, Debug)]
struct OpenFile {
    object: ObjectId,
    offset: usize,
    appends: bool,
}

/// Tracks descriptors, file offsets and names as the kernel does, one system call after another.
pub(super) struct Follower<'a> {
    watched: &'a Path,
    pub(super) disk: Disk,
    pub(super) operations: Vec<Operation>,
    lexer: Lexer,
    /// Position in `open` of the file of each descriptor.
    descriptors: HashMap<String, usize>,
    open: Vec<OpenFile>,
    /// Incomplete last line of standard output.
    line: Vec<u8>,
}

impl<'a> Follower<'a> {
    pub(super) fn new(watched: &'a Path, disk: Disk) -> Follower<'a> {
        Follower {
            watched,
            disk,
            operations: Vec::new(),
            lexer: Lexer::default(),
            descriptors: HashMap::new(),
            open: Vec::new(),
            line: Vec::new(),
        }
    }

    pub(super) fn follow(&mut self, line: &str) -> Result<(), String> {
        match self.lexer.line(line, self.disk.applied()) {
            Some(call) if call.result >= 0 => self.call(&call),
            _ => Ok(()),
        }
    }

    fn act(&mut self, operation: Operation) {
        self.disk.apply(&operation);
        self.operations.push(operation);
    }

    fn call(&mut self, call: &Call) -> Result<(), String> {
        let argument = |position: usize| call.arguments.get(position).map_or("", String::as_str);
        match call.name.as_str() {
            "open" => self.opened("AT_FDCWD", argument(0), argument(1), call),
            "creat" => self.opened("AT_FDCWD", argument(0), "O_WRONLY|O_CREAT|O_TRUNC", call),
            "openat" => self.opened(argument(0), argument(1), argument(2), call),
            "close" => {
                self.descriptors.remove(argument(0));
                Ok(())
            }
            "dup" | "dup2" | "dup3" => self.duplicated(argument(0), call),
            "fcntl" if argument(1).starts_with("F_DUPFD") => self.duplicated(argument(0), call),
            "fcntl" if argument(1) == "F_SETFL" => self.unless_watched(call, &[0]),
            "fcntl" | "sync_file_range" => Ok(()),
            "lseek" => {
                let offset = to_usize(call.result);
                if let Some(file) = self.open_file(argument(0)) {
                    file.offset = offset;
                }
                Ok(())
            }
            "write" | "writev" => self.written(argument(0), argument(1), None, call),
            "pwrite64" | "pwritev" => {
                let offset = argument(3).parse().ok();
                self.written(argument(0), argument(1), offset, call)
            }
            "ftruncate" => self.resized(argument(0), argument(1).parse().ok(), call),
            "fallocate" if argument(1) == "0" => {
                let end = argument(2).parse().ok().zip(argument(3).parse().ok());
                let end = end.map(|(offset, length): (usize, usize)| offset + length);
                let now = self.object_of(argument(0)).map(|id| self.disk.length(id));
                self.resized(argument(0), end.max(now), call)
            }
            "rename" => self.renamed(["AT_FDCWD", argument(0), "AT_FDCWD", argument(1)], "", call),
            "renameat" | "renameat2" => {
                let places = [argument(0), argument(1), argument(2), argument(3)];
                self.renamed(places, argument(4), call)
            }
            "link" => self.linked(["AT_FDCWD", argument(0), "AT_FDCWD", argument(1)]),
            "linkat" => self.linked([argument(0), argument(1), argument(2), argument(3)]),
            "unlink" | "rmdir" => self.removed("AT_FDCWD", argument(0)),
            "unlinkat" => self.removed(argument(0), argument(1)),
            "mkdir" => self.made("AT_FDCWD", argument(0)),
            "mkdirat" => self.made(argument(0), argument(1)),
            "fsync" | "fdatasync" => {
                if let Some(object) = self.object_of(argument(0)) {
                    let covers = call.begun;
                    self.act(Operation::Sync { object, covers });
                }
                Ok(())
            }
            "mmap" if argument(3).contains("MAP_SHARED") && argument(2).contains("PROT_WRITE") => {
                self.unless_watched(call, &[4])
            }
            "mmap" => Ok(()),
            "clone" | "clone3" if call.arguments.join(",").contains("CLONE_THREAD") => Ok(()),
            "fallocate" | "syncfs" | "pwritev2" | "close_range" => self.unless_watched(call, &[0]),
            "copy_file_range" | "splice" => self.unless_watched(call, &[2]),
            "sendfile" => self.unless_watched(call, &[0]),
            _ => Err(format!("`{}({})`", call.name, call.arguments.join(", "))),
        }
    }

    /// Returns an error if an argument of `call` at one of `positions` is a descriptor in the watched folder.
    fn unless_watched(&self, call: &Call, positions: &[usize]) -> Result<(), String> {
        let touched = positions
            .iter()
            .filter_map(|position| call.arguments.get(*position))
            .any(|descriptor| self.descriptors.contains_key(descriptor));
        if touched {
            return Err(format!("`{}({})`", call.name, call.arguments.join(", ")));
        }
        Ok(())
    }

    fn opened(&mut self, at: &str, path: &str, flags: &str, call: &Call) -> Result<(), String> {
        let descriptor = call.result.to_string();
        self.descriptors.remove(&descriptor);
        let Some(place) = self.place(at, path) else {
            return Ok(());
        };
        if flags.contains("O_TMPFILE") {
            return Err(format!("a file without a name: {flags}"));
        }
        let known = match &place {
            (folder, None) => Some(*folder),
            (folder, Some(name)) => self.disk.lookup(*folder, name),
        };
        let object = match (known, place) {
            (Some(object), _) => object,
            (None, (folder, Some(name))) if flags.contains("O_CREAT") => {
                let object = self.disk.next_id();
                self.act(Operation::Create {
                    folder,
                    name,
                    kind: Kind::File,
                });
                object
            }
            (None, place) => return Err(format!("opened {place:?}, which does not exist")),
        };
        if flags.contains("O_TRUNC") && self.disk.length(object) > 0 {
            self.act(Operation::Resize {
                file: object,
                length: 0,
            });
        }
        self.descriptors.insert(descriptor, self.open.len());
        self.open.push(OpenFile {
            object,
            offset: 0,
            appends: flags.contains("O_APPEND"),
        });
        Ok(())
    }

    fn duplicated(&mut self, descriptor: &str, call: &Call) -> Result<(), String> {
        let copy = call.result.to_string();
        match self.descriptors.get(descriptor).copied() {
            Some(open) => self.descriptors.insert(copy, open),
            None => self.descriptors.remove(&copy),
        };
        Ok(())
    }

    fn written(
        &mut self,
        descriptor: &str,
        text: &str,
        at: Option<usize>,
        call: &Call,
    ) -> Result<(), String> {
        let mut bytes = bytes_of(text);
        let length = to_usize(call.result);
        if descriptor == "1" && !self.descriptors.contains_key(descriptor) {
            bytes.truncate(length);
            self.printed(&bytes);
            return Ok(());
        }
        let Some(object) = self.object_of(descriptor) else {
            return Ok(());
        };
        if bytes.len() < length {
            return Err(format!(
                "{length} bytes written, but the trace shows {}",
                bytes.len()
            ));
        }
        bytes.truncate(length);
        let end = self.disk.length(object);
        let offset = match (at, self.open_file(descriptor)) {
            (Some(offset), _) => offset,
            (None, Some(file)) => {
                let offset = if file.appends { end } else { file.offset };
                file.offset = offset + length;
                offset
            }
            (None, None) => return Ok(()),
        };
        self.act(Operation::Write {
            file: object,
            offset,
            bytes,
        });
        Ok(())
    }

    fn printed(&mut self, bytes: &[u8]) {
        for byte in bytes {
            if *byte == b'\n' {
                let line = String::from_utf8_lossy(&std::mem::take(&mut self.line)).into_owned();
                self.act(Operation::Print(line));
            } else {
                self.line.push(*byte);
            }
        }
    }

    fn resized(
        &mut self,
        descriptor: &str,
        length: Option<usize>,
        call: &Call,
    ) -> Result<(), String> {
        match (self.object_of(descriptor), length) {
            (Some(file), Some(length)) => {
                self.act(Operation::Resize { file, length });
                Ok(())
            }
            (Some(_), None) => Err(format!("truncated `{}` without a length", call.name)),
            (None, _) => Ok(()),
        }
    }

    fn renamed(&mut self, places: [&str; 4], flags: &str, call: &Call) -> Result<(), String> {
        let [from_at, from, to_at, to] = places;
        match (self.name(from_at, from), self.name(to_at, to)) {
            (None, None) => Ok(()),
            (Some(one), Some(other)) if flags.contains("EXCHANGE") => {
                self.act(Operation::Exchange { one, other });
                Ok(())
            }
            (Some(from), Some(to)) => {
                self.act(Operation::Rename { from, to });
                Ok(())
            }
            _ => Err(format!(
                "`{}({})`: outside the watched folder",
                call.name,
                call.arguments.join(", ")
            )),
        }
    }

    fn linked(&mut self, places: [&str; 4]) -> Result<(), String> {
        let [from_at, from, to_at, to] = places;
        match (self.name(from_at, from), self.name(to_at, to)) {
            (None, None) => Ok(()),
            (Some((from, old)), Some((folder, name))) => {
                let object = self
                    .disk
                    .lookup(from, &old)
                    .ok_or("a link to a missing file")?;
                self.act(Operation::Link {
                    folder,
                    name,
                    object,
                });
                Ok(())
            }
            _ => Err("a link to a file outside the watched folder".to_owned()),
        }
    }

    fn removed(&mut self, at: &str, path: &str) -> Result<(), String> {
        if let Some((folder, name)) = self.name(at, path) {
            self.act(Operation::Remove { folder, name });
        }
        Ok(())
    }

    fn made(&mut self, at: &str, path: &str) -> Result<(), String> {
        if let Some((folder, name)) = self.name(at, path) {
            self.act(Operation::Create {
                folder,
                name,
                kind: Kind::Folder,
            });
        }
        Ok(())
    }

    fn open_file(&mut self, descriptor: &str) -> Option<&mut OpenFile> {
        let position = *self.descriptors.get(descriptor)?;
        self.open.get_mut(position)
    }

    fn object_of(&self, descriptor: &str) -> Option<ObjectId> {
        let position = *self.descriptors.get(descriptor)?;
        self.open.get(position).map(|file| file.object)
    }

    /// Folder and name of a path; `None` outside the watched folder.
    fn name(&self, at: &str, path: &str) -> Option<(ObjectId, String)> {
        let (folder, name) = self.place(at, path)?;
        name.map(|name| (folder, name))
    }

    /// Like [`name`](Follower::name), but without a name if the path is the folder itself.
    fn place(&self, at: &str, path: &str) -> Option<(ObjectId, Option<String>)> {
        let bytes = bytes_of(path);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let path = Path::new(&text);
        let (mut folder, relative) = if path.is_absolute() {
            (ROOT, path.strip_prefix(self.watched).ok()?)
        } else if at == "AT_FDCWD" {
            (ROOT, path)
        } else {
            (self.object_of(at)?, path)
        };
        let mut name: Option<String> = None;
        for component in relative.components() {
            match component {
                Component::Normal(part) => {
                    if let Some(parent) = name.take() {
                        folder = self.disk.lookup(folder, &parent)?;
                    }
                    name = Some(part.to_string_lossy().into_owned());
                }
                Component::CurDir => {}
                _ => return None,
            }
        }
        Some((folder, name))
    }
}

/// Converts a result that is known to be nonnegative.
fn to_usize(result: i64) -> usize {
    usize::try_from(result).unwrap_or(0)
}
