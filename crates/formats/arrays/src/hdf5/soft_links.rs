//! Soft links of groups with symbol tables, the default of HDF5.
//!
//! `hdf5-pure` treats soft links as damage. This module therefore replaces soft links by hard links to their targets, in the bytes that are read and
//! not in the file.
//!
//! A group has a B-tree of symbol nodes, and a local heap with names. The format specification of HDF5 3.0 describes both in III.A, C and D.

use std::collections::BTreeMap;

use crate::error::Problem;
use crate::limits;
use crate::source::{FileBytes, bytes_of};

/// Maximum nesting of groups, and of links to links.
const DEPTH: usize = 16;
/// Cache type of a symbol node entry for a group. `SOFT_LINK` is the cache type for a soft link.
const GROUP: u32 = 1;
const SOFT_LINK: u32 = 2;
/// Size of an entry, bytes: offset of the name, address of the header, cache type, and 16 bytes of scratch space.
const ENTRY: usize = 40;

/// Maximum size of a patch, bytes.
pub(super) const LONGEST_PATCH: u64 = ENTRY as u64;

/// Replacement bytes for parts of the file, by their offset.
pub(super) type Patches = BTreeMap<u64, Vec<u8>>;

/// Soft links of a file after they were resolved.
#[derive(Default)]
pub(super) struct Followed {
    /// Patches of symbol nodes. They replace soft links by hard links, and remove dead links.
    pub(super) patches: Patches,
    /// Dead and circular links by path, each with its error.
    pub(super) nowhere: Vec<(String, Problem)>,
}

/// Resolves the soft links of a file to hard links. Empty if the file has no symbol tables or no soft links in them.
///
/// # Errors
/// [`Problem`] for a structure that cannot be read.
pub(super) fn followed(file: &FileBytes) -> Result<Followed, Problem> {
    let mut found = Found {
        file,
        base: 0,
        headers: BTreeMap::new(),
        links: BTreeMap::new(),
        entries: 0,
    };
    let start = bytes_of(file, 0, 96)?;
    // After a user block, or with addresses that are not 8 bytes wide, such links are left unchanged.
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
    /// Address of the object header, by the path of each object that has a hard link.
    headers: BTreeMap<String, u64>,
    /// Soft links by path, with the location of the entry and the target.
    links: BTreeMap<String, SoftLink>,
    entries: u64,
}

struct SoftLink {
    node: Node,
    /// Index of the entry in its node.
    position: usize,
    target: String,
}

/// Symbol node, which contains consecutive entries of a group.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Node {
    address: u64,
    used: u64,
}

impl Found<'_> {
    fn bytes(&self, address: u64, length: u64) -> Result<Vec<u8>, Problem> {
        bytes_of(self.file, self.base.saturating_add(address), length)
    }

    /// Visits the group of `entry`, if the entry states a tree and a heap.
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
        // For each node, the headers of its links. A node has several paths if its group has several.
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

    /// Adds the patches of a node whose links became hard links. A dead link is removed, and later entries move up.
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

    /// Address of the object header at `path`, also through other links. `None` if the path leads to no object.
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

/// Error for a dead link.
fn leads_nowhere(path: &str, target: &str) -> Problem {
    let name = path.trim_start_matches('/');
    Problem::unsupported(
        format!("the soft link `{path}` leads to `{target}`, which does not exist"),
        format!(
            "remove it: `with h5py.File(path, 'a') as f: del f['{name}']`, or give it an existing target"
        ),
    )
}

/// Full path of the target of a link at `path`.
fn absolute(path: &str, target: &str) -> String {
    let parent = path.rsplit_once('/').map_or("", |(parent, _)| parent);
    let begin = if target.starts_with('/') { "" } else { parent };
    let parts = begin.split('/').chain(target.split('/'));
    let parts: Vec<&str> = parts.filter(|part| !matches!(*part, "" | ".")).collect();
    format!("/{}", parts.join("/"))
}

/// Zero-terminated text at the offset `at` of a heap.
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
