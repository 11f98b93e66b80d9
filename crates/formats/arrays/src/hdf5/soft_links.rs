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

/// The longest of the texts that are read in the place of those of a file, bytes.
pub(super) const LONGEST_PATCH: u64 = ENTRY as u64;

/// Bytes that are read in the place of those of the file, by their place in it.
pub(super) type Patches = BTreeMap<u64, Vec<u8>>;

/// What becomes of the soft links of a file.
#[derive(Default)]
pub(super) struct Followed {
    /// The links as hard ones, and those that lead nowhere taken out.
    pub(super) patches: Patches,
    /// The links that lead nowhere, or in a circle, with the words for whoever reads them.
    pub(super) nowhere: Vec<(String, Problem)>,
}

/// What the soft links of a file would be as hard ones; none where it has no symbol tables, or no such links.
///
/// # Errors
/// [`Problem`] naming what does not read.
pub(super) fn followed(file: &FileBytes) -> Result<Followed, Problem> {
    let mut found = Found {
        file,
        base: 0,
        headers: BTreeMap::new(),
        links: BTreeMap::new(),
        entries: 0,
    };
    let start = bytes_of(file, 0, 96)?;
    // Behind a user block, and of other widths of addresses than 8 bytes, such links stay what they are.
    let is_known =
        start.starts_with(b"\x89HDF\r\n\x1a\n") && start[8] < 2 && start[13..15] == [8, 8];
    if !is_known {
        return Ok(Followed::default());
    }
    let root = if start[8] == 0 { 56 } else { 60 };
    found.base = number(&start[root - 32..]);
    found.group(&bytes_of(file, root as u64, ENTRY as u64)?, "", 0)?;
    found.followed()
}

struct Found<'f> {
    file: &'f FileBytes,
    base: u64,
    /// Of each object that a hard link leads to, the address of its header.
    headers: BTreeMap<String, u64>,
    /// Of each soft link, by its path, where its entry is and what it leads to.
    links: BTreeMap<String, SoftLink>,
    entries: u64,
}

struct SoftLink {
    node: Node,
    /// Which entry of the node it is.
    position: usize,
    target: String,
}

/// A symbol node: entries of a group, one behind the other.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Node {
    address: u64,
    used: u64,
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
                b"SNOD" => self.node(address, used, &names, path, depth)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn node(
        &mut self,
        address: u64,
        used: u64,
        names: &[u8],
        path: &str,
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
                let link = SoftLink {
                    node: Node { address, used },
                    position,
                    target: target.unwrap_or_default(),
                };
                self.links.insert(path, link);
            } else {
                self.headers.insert(path.clone(), number(&entry[8..]));
                self.group(entry, &path, depth + 1)?;
            }
        }
        Ok(())
    }

    fn followed(&self) -> Result<Followed, Problem> {
        let mut followed = Followed::default();
        // Of each node the headers that its links lead to: a node has several paths where a group has.
        let mut nodes: BTreeMap<Node, BTreeMap<usize, Option<u64>>> = BTreeMap::new();
        for (path, link) in &self.links {
            let header = self.header(&absolute(path, &link.target), 0);
            let links = nodes.entry(link.node).or_default();
            let own = links.entry(link.position).or_default();
            *own = own.or(header);
            if own.is_none() {
                followed
                    .nowhere
                    .push((path.clone(), leads_nowhere(path, &link.target)));
            }
        }
        for (node, links) in nodes {
            self.patch(node, &links, &mut followed.patches)?;
        }
        Ok(followed)
    }

    /// The entries of a node with its links as hard ones. Behind one that leads nowhere, which is left out, the others move up.
    fn patch(
        &self,
        node: Node,
        links: &BTreeMap<usize, Option<u64>>,
        patches: &mut Patches,
    ) -> Result<(), Problem> {
        let entries = self.bytes(node.address.saturating_add(8), node.used * ENTRY as u64)?;
        let at = self.base.saturating_add(node.address);
        let mut kept: u16 = 0;
        for (position, entry) in entries.chunks_exact(ENTRY).enumerate() {
            let mut own = entry.to_vec();
            match links.get(&position) {
                Some(None) => continue,
                Some(Some(header)) => {
                    own[8..16].copy_from_slice(&header.to_le_bytes());
                    own[16..20].fill(0);
                }
                None => {}
            }
            let place = 8 + u64::from(kept) * ENTRY as u64;
            if own != entry || usize::from(kept) != position {
                patches.insert(at.saturating_add(place), own);
            }
            kept += 1;
        }
        if u64::from(kept) != node.used {
            patches.insert(at.saturating_add(6), kept.to_le_bytes().to_vec());
        }
        Ok(())
    }

    /// The header of the object at `path`, through other links too.
    fn header(&self, path: &str, hops: usize) -> Option<u64> {
        if let Some(header) = self.headers.get(path) {
            return Some(*header);
        }
        if hops == DEPTH {
            return None;
        }
        let ends = path.match_indices('/').map(|(at, _)| at).skip(1);
        let mut ends = ends.chain([path.len()]);
        let (end, link) = ends.find_map(|end| Some((end, self.links.get(&path[..end])?)))?;
        let target = absolute(&path[..end], &link.target);
        self.header(&format!("{target}{}", &path[end..]), hops + 1)
    }
}

/// What is said of a link to whoever reads it.
fn leads_nowhere(path: &str, target: &str) -> Problem {
    let name = path.trim_start_matches('/');
    Problem::unsupported(
        format!("the soft link `{path}` leads to `{target}`, which is not there"),
        format!(
            "remove it: `with h5py.File(path, 'a') as f: del f['{name}']`, or name what it should lead to"
        ),
    )
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
