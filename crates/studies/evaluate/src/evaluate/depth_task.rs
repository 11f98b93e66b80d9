//! Scores of a task of depth maps: a model of numbers predicts the maps of clusters that it has not seen.

use taceva_core::{Channel, Channels, Column, Unit, shown};
use taceva_dataset::{Dataset, Task};
use taceva_tasks::TaskState;
use taceva_tasks::depth::DepthMap;

use super::depth_cells::Cells;
use super::fold_progress::FoldProgress;
use super::folds::{self, Folds};
use super::label_counts::{own_labels, unscored};
use crate::cache::Cache;
use crate::depth_pairs::{DepthPairs, definition, of_sample};
use crate::error::EvaluateError;
use crate::fit::{FitPlan, FitRequest, Recipe};
use crate::mean_map::mean_map;
use crate::predict::{Target, predict_target};
use crate::rows::{DataPart, Divided};
use crate::work::Work;

/// Sums behind the scores of the depth maps of `task`. Models fitted by `fit` predict the cells of the maps in the test part of each division of
/// `split`.
///
/// The constant prediction is the mean map of the training part. Several divisions share no training part, so their constant prediction is the mean
/// of all maps.
pub(super) fn state(
    dataset: &Dataset,
    task: &Task,
    fit: FitRequest,
    split: &str,
    work: Work<'_>,
) -> Result<TaskState, EvaluateError> {
    let fit = FitRequest {
        channels: Vec::new(),
        ..fit
    };
    let (cells, labelled) = of_cells(dataset, task)?;
    let found = folds::of_spec(&labelled, fit.seed, split.parse()?)?;
    let groups = found
        .as_ref()
        .and_then(Folds::groups)
        .map(<[String]>::to_vec);
    let divisions = match found {
        Some(folds) => folds.into_divisions(),
        None => vec![Divided::of(&labelled, Some(split), fit.seed)?],
    };
    let averaged = match divisions.as_slice() {
        [only] => only.rows(DataPart::Train),
        _ => dataset.all_rows(),
    };
    let definition = definition(task)?;
    let definition = match mean_map(dataset, &task.name, &averaged)? {
        Some(mean) => definition.with_constant(mean),
        None => definition,
    };
    let own;
    let cache = match work.cache {
        Some(cache) if cache.is_in_memory() => cache,
        outer => {
            own = Cache::of_folds(outer);
            &own
        }
    };
    let labels = dataset.table().task(&task.name);
    let has_map = |row: usize| labels.is_some_and(|own| own.label(row).is_some());
    let (mut scored, count) = (0, divisions.len());
    let mut pairs = DepthPairs::new(dataset, task, definition);
    for (number, divided) in (1_usize..).zip(divisions) {
        divided.require_test()?;
        let name = format!("fold {number} of {count}");
        let progress = FoldProgress::of(work.progress, fit.model.name(), name);
        let work = Work {
            progress: &progress,
            cache: Some(cache),
            ..work
        };
        let mut plan = FitPlan::on(&labelled, &fit, Recipe::of(&fit)?, divided)?;
        if let Some(groups) = &groups {
            plan.leave_out_groups(groups);
        }
        let fitted = plan.run(work)?;
        let model = &fitted.model;
        let target = Target::of(&labelled, Some(fitted.divided), None, model.reads_frames())?;
        let predicted = predict_target(&labelled, model, &target, work)?;
        for (at, &row) in target.rows.iter().enumerate() {
            let depths = predicted.prediction().iter().map(|cell| cell.get(at));
            let depths: Option<Vec<f64>> = depths.collect();
            let Some(depths) = depths.filter(|_| has_map(row)) else {
                continue;
            };
            let [rows, columns] = cells.pixels();
            pairs.push(row, || {
                DepthMap::new(rows, columns, cells.map(&depths))
                    .map_err(|error| of_sample(dataset, task, row, &error))
            })?;
            scored += 1;
        }
    }
    let mut state = pairs.into_state(" of the test part")?;
    let [down, across] = cells.grid();
    let of = match count {
        1 => "the training part",
        _ => "all samples, because the models of the folds share no training part",
    };
    state.notes.extend([
        format!("maps are predicted as {down} x {across} mean depths, with linear interpolation between them"),
        format!("the constant is the mean map of {of}"),
    ]);
    let unscored = unscored(scored, own_labels(dataset, &task.name));
    state.notes.extend(unscored);
    Ok(state)
}

/// Cells of the maps of `task`, and the dataset whose channels are the depths of these cells.
fn of_cells(dataset: &Dataset, task: &Task) -> Result<(Cells, Dataset), EvaluateError> {
    let refused = |problem: String| {
        EvaluateError::Request(format!("task `{}`: {problem}", shown(&task.name)))
    };
    let mut found: Option<Cells> = None;
    let mut means = Vec::with_capacity(dataset.table().rows());
    for row in 0..dataset.table().rows() {
        let Some(map) = dataset.depth_map(&task.name, row)? else {
            means.push(None);
            continue;
        };
        let own = Cells::of([map.rows, map.columns]);
        let first = *found.get_or_insert(own);
        if own != first {
            let [rows, columns] = first.pixels();
            return Err(refused(format!(
                "maps of {rows} x {columns} and of {} x {} pixels, expected one size: evaluate recordings with maps of one size",
                map.rows, map.columns
            )));
        }
        means.push(own.means(&map.mm));
    }
    let cells = found.ok_or_else(|| refused("no sample has a depth map".to_owned()))?;
    let depths = |cell: usize| {
        let mut column = Column::default();
        let of_rows = means
            .iter()
            .map(|depths: &Option<Vec<f64>>| Some(depths.as_ref()?[cell]));
        of_rows.for_each(|depth| column.push(depth));
        column
    };
    let labels: Vec<Column> = (0..cells.count()).map(depths).collect();
    // Channels are in the order of their names.
    let channel = |cell: usize| Channel::named(&format!("cell_{cell:04}"), Unit::Millimetre);
    let named = (0..cells.count())
        .map(channel)
        .collect::<Result<Vec<_>, _>>();
    let channels = named.and_then(Channels::new);
    let channels = channels.map_err(|error| refused(error.to_string()))?;
    Ok((cells, dataset.with_labels(&task.name, &channels, &labels)?))
}
