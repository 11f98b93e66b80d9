//! Cache of the commands, and `taceva cache`.

mod list;
mod prune;

use std::path::PathBuf;

use taceva_evaluate::Cache;

use super::{Context, Usage, run::bench};
use crate::args::{CacheArgs, CacheCommand, CacheSubject};

pub(crate) fn run(args: &CacheCommand, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        CacheSubject::List(args) => list::run(args),
        CacheSubject::Prune(args) => prune::run(args, context),
    }
}

/// Folder of the cache: `named`, or otherwise the folder of the user.
fn folder_of(named: Option<PathBuf>) -> anyhow::Result<PathBuf> {
    named.or_else(of_user).ok_or_else(|| {
        Usage::error(
            "no folder for the cache: set HOME or XDG_CACHE_HOME to an absolute path, or name the cache with --cache DIR",
        )
    })
}

/// The cache to use; `None` with `--no-cache`, or if the user has no cache folder.
pub(super) fn of(args: &CacheArgs) -> Option<Cache> {
    if args.no_cache {
        return None;
    }
    let folder = args.cache.clone().or_else(of_user)?;
    Some(Cache::new(folder, bench::models()))
}

/// Prints problems of the cache.
pub(super) fn note(cache: Option<&Cache>, context: &Context) {
    for note in cache.into_iter().flat_map(Cache::notes) {
        context.say(format_args!("{note}"));
    }
}

/// Folder `taceva` in the user's cache folder; `None` without a cache folder. Relative paths are ignored, as the XDG specification requires.
fn of_user() -> Option<PathBuf> {
    let folder = |variable| std::env::var_os(variable).map(PathBuf::from);
    let caches = folder("XDG_CACHE_HOME").filter(|path| path.is_absolute());
    let caches = caches.or_else(|| Some(folder("HOME")?.join(".cache")));
    caches
        .filter(|path| path.is_absolute())
        .map(|path| path.join("taceva"))
}
