//! Soft links of groups as files have them by default (symbol tables), which `hdf5-pure` takes for damage: they become hard ones to what they
//! lead to, in what is read of the file and not in the file.
//!
//! Structures as in the format specification of HDF5 3.0, III.A, C and D: a B-tree of symbol nodes and a local heap with their names a group.

use std::collections::BTreeMap;

use crate::error::Problem;
use crate::limits;
use crate::source::{FileBytes, bytes_of};

/// Groups within groups, and links that lead to links.
const DEPTH: usize = 16;
/// What an entry of a symbol node says that it is: a group whose tree and heap it names, a soft link whose target it names.
const GROUP: u32 = 1;
const SOFT_LINK: u32 = 2;
/// Bytes of an entry: where its name is, where its header is, what it is, and 16 bytes for that.
const ENTRY: usize = 40;

/// Bytes that are read in the place of those of the file, by their place in it.
pub(super) type Patches = BTreeMap<u64, [u8; 12]>;

/// What the soft links of a file would be as hard ones; none where it has no symbol tables, or no such links.
///
/// # Errors
/// [`Problem`] naming a link that leads nowhere, or what does not read.
pub(super) fn followed(file: &FileBytes) -> Result<Patches, Problem> {
    let mut found = Found {
        file,
        base: 0,
        headers: BTreeMap::new(),
        links: Vec::new(),
        entries: 0,
    };
    let start = bytes_of(file, 0, 96)?;
    // Behind a user block, and of other widths of addresses than 8 bytes, such links stay what they are.
    let is_known =
        start.starts_with(b"\x89HDF\r\n\x1a\n") && start[8] < 2 && start[13..15] == [8, 8];
    if !is_known {
        return Ok(Patches::new());
    }
    let root = if start[8] == 0 { 56 } else { 60 };
    found.base = number(&start[root - 32..]);
    found.group(&bytes_of(file, root as u64, ENTRY as u64)?, "", 0)?;
    found.patches()
}

struct Found<'f> {
    file: &'f FileBytes,
    base: u64,
    /// Of each object that a hard link leads to, the address of its header.
    headers: BTreeMap<String, u64>,
    links: Vec<SoftLink>,
    entries: u64,
}

struct SoftLink {
    /// Where its entry lies in the file.
    at: u64,
    path: String,
    target: String,
}

impl Found<'_> {
    fn bytes(&self, address: u64, length: u64) -> Result<Vec<u8>, Problem> {
        bytes_of(self.file, self.base.saturating_add(address), length)
    }

    /// The group that `entry` leads to, if it says where its tree and its heap are.
    fn group(&mut self, entry: &[u8], path: &str, depth: usize) -> Result<(), Problem> {
        if number32(&entry[16..]) != GROUP || depth == DEPTH {
            return Ok(());
        }
        let (tree, heap) = (number(&entry[24..]), number(&entry[32..]));
        let header = self.bytes(heap, 32)?;
        let size = number(&header[8..]);
        if !header.starts_with(b"HEAP") || size > limits::CHUNK_BYTES {
            return Ok(());
        }
        let names = self.bytes(number(&header[24..]), size)?;
        let mut nodes = vec![(tree, 0)];
        while let Some((address, level)) = nodes.pop() {
            self.entries += 1;
            if self.entries > limits::ARRAYS {
                return Ok(());
            }
            let head = self.bytes(address, 24)?;
            let used = u64::from(u16::from_le_bytes([head[6], head[7]]));
            match &head[..4] {
                b"TREE" if level < DEPTH => {
                    let children = self.bytes(address.saturating_add(24), 16 * used + 8)?;
                    let children = children[8..].chunks_exact(16);
                    nodes.extend(children.map(|child| (number(child), level + 1)));
                }
                b"SNOD" => self.node(address, used, (&names, path), depth)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn node(
        &mut self,
        address: u64,
        used: u64,
        (names, path): (&[u8], &str),
        depth: usize,
    ) -> Result<(), Problem> {
        let entries = self.bytes(address.saturating_add(8), used * ENTRY as u64)?;
        for (position, entry) in entries.chunks_exact(ENTRY).enumerate() {
            self.entries += 1;
            if self.entries > limits::ARRAYS {
                return Ok(());
            }
            let Some(name) = text(names, number(entry)) else {
                continue;
            };
            let path = format!("{path}/{name}");
            if number32(&entry[16..]) == SOFT_LINK {
                let target = text(names, u64::from(number32(&entry[24..])));
                self.links.push(SoftLink {
                    at: self
                        .base
                        .saturating_add(address)
                        .saturating_add(8 + (position * ENTRY) as u64),
                    path,
                    target: target.unwrap_or_default(),
                });
            } else {
                self.headers.insert(path.clone(), number(&entry[8..]));
                self.group(entry, &path, depth + 1)?;
            }
        }
        Ok(())
    }

    fn patches(&self) -> Result<Patches, Problem> {
        let patch = |link: &SoftLink| {
            let header = self.header(&absolute(&link.path, &link.target), 0);
            let header = header.ok_or_else(|| {
                let name = link.path.trim_start_matches('/');
                Problem::unsupported(
                    format!(
                        "the soft link `{}` leads to `{}`, which is not there",
                        link.path, link.target
                    ),
                    format!("remove it: `with h5py.File(path, 'a') as f: del f['{name}']`"),
                )
            })?;
            let mut bytes = [0; 12];
            bytes[..8].copy_from_slice(&header.to_le_bytes());
            Ok((link.at.saturating_add(8), bytes))
        };
        self.links.iter().map(patch).collect()
    }

    /// The header of the object at `path`, through other links too.
    fn header(&self, path: &str, hops: usize) -> Option<u64> {
        if let Some(header) = self.headers.get(path) {
            return Some(*header);
        }
        let within = |link: &&SoftLink| {
            let rest = path.strip_prefix(&link.path);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        let link = self.links.iter().find(within).filter(|_| hops < DEPTH)?;
        let target = absolute(&link.path, &link.target);
        self.header(&format!("{target}{}", &path[link.path.len()..]), hops + 1)
    }
}

/// The full path of what a link at `path` leads to.
fn absolute(path: &str, target: &str) -> String {
    let parent = path.rsplit_once('/').map_or("", |(parent, _)| parent);
    let begin = if target.starts_with('/') { "" } else { parent };
    let parts = begin.split('/').chain(target.split('/'));
    let parts: Vec<&str> = parts.filter(|part| !matches!(*part, "" | ".")).collect();
    format!("/{}", parts.join("/"))
}

/// The text at a place of a heap, which ends with a zero.
fn text(heap: &[u8], at: u64) -> Option<String> {
    let rest = heap.get(usize::try_from(at).ok()?..)?;
    let end = rest.iter().position(|byte| *byte == 0)?;
    String::from_utf8(rest[..end].to_vec()).ok()
}

fn number(bytes: &[u8]) -> u64 {
    let own = bytes.first_chunk().copied();
    own.map_or(u64::MAX, u64::from_le_bytes)
}

fn number32(bytes: &[u8]) -> u32 {
    let own = bytes.first_chunk().copied();
    own.map_or(u32::MAX, u32::from_le_bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_is_of_the_root_or_beside_its_link() {
        assert_eq!(absolute("/run/up", "/run"), "/run");
        assert_eq!(absolute("/run/first", "frames"), "/run/frames");
        assert_eq!(absolute("/first", "./run/frames"), "/run/frames");
    }
}
