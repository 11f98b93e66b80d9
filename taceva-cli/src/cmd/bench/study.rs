//! `taceva bench study`.

use std::path::Path;

use taceva_acquire::Workshop;
use taceva_study::RunSetup;
use taceva_study::bench::{StudyGrid, studies};

use super::super::run::bench::surroundings;
use super::super::{Context, results, scene};
use super::bench_recording::Folder;
use super::models::here;
use crate::args::BenchStudy;
use crate::report::study_bench;
use crate::{exit, output};

pub(super) fn run(args: &BenchStudy, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(args.output.path.iter(), args.output.force)?;
    let (drivers, models) = context.equipment(Path::new(&args.scene))?;
    let setup = RunSetup {
        workshop: Workshop {
            drivers: &drivers,
            surroundings: &surroundings,
            progress: &context.progress,
            operator: None,
            viewer: None,
        },
        models: &models,
        cache: None,
        jobs: context.jobs,
    };
    let grid = StudyGrid {
        study: args.study.clone(),
        seed: args.seed,
        seeds: args.seeds,
        points: args.points.clone(),
        folds: args.folds.iter().map(|folds| folds.0).collect(),
        models: args.models.clone(),
    };
    let entries = grid.entries(&scene::text(&args.scene)?, setup)?;
    let folder = Folder::new();
    let bench = studies(&entries, &folder.0, here(context), setup)?;
    results::write(&study_bench::rows(&bench), &args.output, || bench.json())?;
    Ok(exit::DONE)
}
