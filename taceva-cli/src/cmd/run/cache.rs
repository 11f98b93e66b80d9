//! Where finished stages are kept, and what is said of those that were found.

use std::path::PathBuf;

use serde::Serialize;
use taceva_study::{Cache, RunFolder, StageRecord};

use super::{Context, bench};
use crate::args::Run;
use crate::output;

/// The cache that was asked for; `None` if none is wanted, or if the user has no folder for one.
pub(super) fn of(args: &Run) -> Option<Cache> {
    if args.no_cache {
        return None;
    }
    let folder = args.cache.clone().or_else(of_user)?;
    Some(Cache::new(folder, bench::models()))
}

/// The folder `taceva` in the user's cache folder; a relative one is not to be followed.
fn of_user() -> Option<PathBuf> {
    let folder = |variable| std::env::var_os(variable).map(PathBuf::from);
    let caches = folder("XDG_CACHE_HOME").filter(|path| path.is_absolute());
    let caches = caches.or_else(|| Some(folder("HOME")?.join(".cache")));
    caches
        .filter(|path| path.is_absolute())
        .map(|path| path.join("taceva"))
}

/// Schema `taceva.stages/1`.
#[derive(Serialize)]
struct Stages {
    schema: &'static str,
    stages: Vec<StageRecord>,
}

/// Says what was found and what went wrong, and writes the stages into the folder of the run, where no report depends on them.
pub(super) fn tell(cache: &Cache, folder: &RunFolder, context: &Context) -> anyhow::Result<()> {
    for note in cache.notes() {
        context.say(format_args!("{note}"));
    }
    let stages = cache.stages();
    for record in &stages {
        let done = if record.reused { "reused" } else { "done" };
        let (stage, study) = (record.stage.name(), &record.study);
        context.say_more(format_args!("{study}: {stage} {done} {}", record.key));
    }
    let stages = Stages {
        schema: "taceva.stages/1",
        stages,
    };
    output::write(Some(&folder.stages()), |out| {
        serde_json::to_writer_pretty(&mut *out, &stages)?;
        writeln!(out)
    })
}
