//! Acquires scenes like `taceva run`, in one process at a time.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use anyhow::Context as _;
use taceva_acquire::Workshop;
use taceva_core::{Progress, shown};
use taceva_evaluate::{Cache, Claim, Watch};
use taceva_models::Models;
use taceva_study::{Existing, RunFolder, RunSetup, acquire_scene};
use taceva_sweep::{SceneTime, SweepFolder};

use super::SweepScene;
use crate::args::CacheArgs;
use crate::cmd::{Context, cache, run::bench, scene};
use crate::progress;

/// Interval of checks for the end of an acquisition by another process.
const LOOK_EVERY: Duration = Duration::from_millis(200);
/// Message after an interruption.
const STOPPED: &str = "stopped while a scene was acquired; the same command continues from here";

/// Folder, models and cache that an acquisition uses.
pub(crate) struct Acquisition<'a> {
    pub(crate) folder: &'a SweepFolder,
    pub(crate) models: &'a Models,
    /// Cache of simulated recordings, shared with `taceva run`.
    pub(crate) cache: &'a CacheArgs,
}

/// Acquires the incomplete scenes of `scenes` in turn. True if at least one was incomplete.
pub(crate) fn acquire(
    scenes: &[SweepScene],
    acquisition: &Acquisition<'_>,
    context: &Context,
) -> anyhow::Result<bool> {
    let left = scenes.iter().filter(|scene| !scene.is_acquired);
    let mut is_any = false;
    for scene in left {
        scene.acquire(acquisition, context)?;
        is_any = true;
    }
    Ok(is_any)
}

impl SweepScene {
    fn acquire(&self, with: &Acquisition<'_>, context: &Context) -> anyhow::Result<()> {
        let (planned, path) = (&self.planned, self.run.path());
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let _claim = claim(&with.folder.scene_claim(&name), context)?;
        // Another process may have begun or finished the scene meanwhile.
        let is_begun = self.run.is_begun(planned)?;
        if is_begun && self.run.is_acquired(planned)? {
            return Ok(());
        }
        context.say(format_args!(
            "scene {}: acquired into {}",
            shown(&planned.scene.name),
            shown(path)
        ));
        scene::print_cost(planned, path, context)?;
        let existing = match is_begun {
            true => Existing::Resume,
            false => Existing::Refuse,
        };
        let run = RunFolder::open(path, planned, existing)?;
        let cache = cache::of(with.cache);
        let progress = Counted::of(&context.progress);
        let workshop = Workshop {
            drivers: &self.drivers,
            surroundings: &bench::surroundings,
            progress: &progress,
            operator: None,
            viewer: None,
        };
        let setup = RunSetup {
            workshop,
            models: with.models,
            cache: cache.as_ref(),
            jobs: context.jobs,
        };
        let began = Instant::now();
        let acquired = acquire_scene(planned, &run, setup);
        let mut stages = cache.iter().flat_map(Cache::stages);
        // A resumed run and presses from the cache do not show the time of a press.
        let is_timed = !is_begun && stages.all(|stage| !stage.reused);
        if is_timed && progress.steps() > 0 {
            SceneTime::new(progress.steps(), began.elapsed()).keep(with.folder, &name);
        }
        acquired.with_context(|| match progress::is_stopped() {
            true => STOPPED.to_owned(),
            false => {
                run.remove_if_untouched();
                format!("scene {}", shown(&planned.scene.name))
            }
        })?;
        cache::note(cache.as_ref(), context);
        Ok(())
    }
}

/// Acquires the claim file at `path`. Waits while another process holds the claim.
fn claim(path: &Path, context: &Context) -> anyhow::Result<Claim> {
    let of_path = || format!("cannot claim {}", shown(path));
    let mut watch: Option<Watch> = None;
    loop {
        if let Some(claim) = Claim::take(path).with_context(of_path)? {
            return Ok(claim);
        }
        match &mut watch {
            None => {
                context.say(format_args!(
                    "another process is acquiring the scene: waiting for it"
                ));
                watch = Some(Watch::new(path));
            }
            Some(watch) => {
                if !watch.clear().with_context(of_path)? {
                    std::thread::sleep(LOOK_EVERY);
                }
            }
        }
        if context.progress.is_cancelled() {
            anyhow::bail!(STOPPED);
        }
    }
}

/// Progress that counts steps.
struct Counted<'a> {
    whole: &'a dyn Progress,
    steps: AtomicU64,
}

impl<'a> Counted<'a> {
    fn of(whole: &'a dyn Progress) -> Counted<'a> {
        Counted {
            whole,
            steps: AtomicU64::new(0),
        }
    }

    fn steps(&self) -> u64 {
        self.steps.load(Ordering::Relaxed)
    }
}

impl Progress for Counted<'_> {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        self.whole.begin(stage, steps);
    }

    fn advance(&self, steps: u64) {
        self.steps.fetch_add(steps, Ordering::Relaxed);
        self.whole.advance(steps);
    }

    fn end(&self) {
        self.whole.end();
    }

    fn is_cancelled(&self) -> bool {
        self.whole.is_cancelled()
    }

    fn is_insisted(&self) -> bool {
        self.whole.is_insisted()
    }
}
