//! `taceva cache prune`.

use std::time::SystemTime;

use anyhow::Context as _;
use taceva_core::counted;
use taceva_evaluate::{Pruning, cache_entries, pruned, remove_entry};

use crate::amount::bytes;
use crate::args::CachePrune;
use crate::cmd::Context;
use crate::{exit, output};

pub(super) fn run(args: &CachePrune, context: &Context) -> anyhow::Result<u8> {
    let is_explained = args.explain.is_wanted;
    let folder = super::folder_of(args.cache.path.clone())?;
    let read = || format!("cannot read {}", taceva_core::shown(&folder));
    let entries = cache_entries(&folder).with_context(read)?;
    let pruning = Pruning {
        stages: args.kind.iter().map(|kind| (*kind).into()).collect(),
        older_than: args.older_than,
        keep: args.keep,
    };
    let going = pruned(&entries, &pruning, SystemTime::now());
    for entry in &going {
        context.say_more(format_args!(
            "{} {} {}",
            entry.kind(),
            entry.name,
            bytes(entry.bytes)
        ));
        if !is_explained {
            remove_entry(&folder, entry)
                .with_context(|| format!("cannot remove {}", taceva_core::shown(&entry.path)))?;
        }
    }
    let freed = going.iter().map(|entry| entry.own_bytes).sum();
    let staying: u64 = entries.iter().map(|entry| entry.bytes).sum::<u64>()
        - going.iter().map(|entry| entry.bytes).sum::<u64>();
    let verb = if is_explained {
        "would remove"
    } else {
        "removed"
    };
    output::write(None, |out| {
        writeln!(
            out,
            "{verb} {} of {}, which frees {}; {} are left in {}",
            going.len(),
            counted(entries.len(), "entry"),
            bytes(freed),
            bytes(staying),
            taceva_core::shown(&folder)
        )
    })?;
    Ok(exit::DONE)
}
