//! Samples of a shard, and bytes of their members.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::Arc;

use crate::foreign::tar::{FileTape, Members, TarError};

/// Byte range of a member in a shard.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    at: u64,
    size: u64,
}

#[derive(Debug, Default)]
pub(super) struct Sample {
    pub(super) key: String,
    /// Byte range of each member, by the part of its name after the first dot.
    pub(super) parts: BTreeMap<Arc<str>, Extent>,
}

/// Samples of a shard in file order.
pub(super) fn samples(path: &Path) -> Result<Vec<Sample>, TarError> {
    let file = File::open(path)?;
    let length = file.metadata()?.len();
    let mut members = Members::new(FileTape {
        file: BufReader::new(file),
        length,
    });
    let mut samples: Vec<Sample> = Vec::new();
    let mut endings: BTreeSet<Arc<str>> = BTreeSet::new();
    while let Some(member) = members.next()? {
        let (folder, name) = member.name.rsplit_once('/').unwrap_or(("", &member.name));
        let Some((stem, ending)) = name.split_once('.').filter(|(stem, _)| !stem.is_empty()) else {
            continue;
        };
        let key = match folder {
            "" => stem.to_owned(),
            folder => format!("{folder}/{stem}"),
        };
        let ending = ending.to_ascii_lowercase();
        let ending = match endings.get(ending.as_str()) {
            Some(known) => Arc::clone(known),
            None => {
                let ending: Arc<str> = ending.into();
                endings.insert(Arc::clone(&ending));
                ending
            }
        };
        if samples.last().is_none_or(|last| last.key != key) {
            samples.push(Sample {
                key,
                ..Sample::default()
            });
        }
        let extent = Extent {
            at: member.at,
            size: member.size,
        };
        if let Some(sample) = samples.last_mut()
            && sample.parts.insert(ending, extent).is_some()
        {
            return Err(TarError::Twice(member.name));
        }
    }
    Ok(samples)
}

pub(super) fn bytes_at(file: &mut File, extent: Extent, cap: u64) -> Result<Vec<u8>, String> {
    let Extent { at, size } = extent;
    if size > cap {
        return Err(format!("{size} bytes, expected at most {cap}"));
    }
    let mut bytes = Vec::new();
    let read = file
        .seek(SeekFrom::Start(at))
        .and_then(|_| file.take(size).read_to_end(&mut bytes));
    read.map_err(|error| error.to_string())?;
    match bytes.len() as u64 == size {
        true => Ok(bytes),
        false => Err("the file of the shard shrank while it was read: import it again when nothing writes to it".to_owned()),
    }
}
