//! Pages of a sweep: a page of results and a page of run times.

mod times;

use taceva_core::counted;
use taceva_report::{Cell, Column, PagePart, PageSection, Table, TablesPage};
use taceva_results::not_measured;

use crate::analysis::{self, Found, Loaded};
use crate::choices;
use crate::collected_counts::Collected;
use crate::decisions;
use crate::effects;
use crate::task_list::TaskList;
use crate::units;

pub(crate) use times::times;

/// Page of results; the same results give the same bytes.
pub(crate) fn results(list: &TaskList, loaded: &[Loaded<'_>], collected: &Collected) -> String {
    let channels = analysis::channels(loaded);
    let groups = analysis::groups(loaded);
    let choices = choices::choices(&groups, &channels);
    let mut sections = Vec::new();
    let mut section = |id, title, parts| sections.push(PageSection { id, title, parts });
    let partial = groups.iter().filter(|group| !group.is_whole).count();
    let mut best = vec![PagePart::Table(choices::table(&groups, &choices))];
    if partial > 0 {
        best.push(PagePart::Words(format!(
            "{partial} of {} configurations lack a result for some seed. A choice is made among configurations with results for the same \
             seeds; the others are compared with it on the seeds of both.",
            groups.len()
        )));
    }
    section("best", "Best of each question", best);
    if !collected.units.is_empty() {
        section(
            "units",
            "Units",
            vec![PagePart::Table(units::table(&collected.units))],
        );
    }
    let effects = effects::table(loaded, list, &channels);
    section(
        "effects",
        "Effect of each setting",
        vec![PagePart::Table(effects)],
    );
    let decided = decisions::table(&groups, &choices);
    let count = counted(decided.rows.len(), "pair");
    section(
        "compared",
        "Compared",
        vec![PagePart::Folded("compared-all", count, decided)],
    );
    let left = left(loaded);
    if !left.rows.is_empty() {
        section("failed", "Without a result", vec![PagePart::Table(left)]);
    }
    let lead = format!(
        "{}: {} scored, {} failed, {} not run.",
        counted(list.tasks.len(), "task"),
        collected.scored,
        collected.failed,
        collected.missing
    );
    TablesPage {
        title: title(list),
        badge: badge(loaded),
        lead: vec![
            lead,
            format!("The table has the digest {}.", collected.digest),
        ],
        sections,
    }
    .html()
}

fn title(list: &TaskList) -> String {
    match list.name.as_str() {
        "" => "Sweep".to_owned(),
        name => name.to_owned(),
    }
}

/// Badge for a page with simulated or synthetic samples; `None` for recorded samples only.
fn badge(loaded: &[Loaded<'_>]) -> Option<String> {
    let results = loaded.iter().filter_map(Loaded::result);
    not_measured(results.map(|result| result.source.as_str()))
}

/// Table of the tasks without a result.
fn left(loaded: &[Loaded<'_>]) -> Table {
    let columns = ["task", "recording", "model", "split", "seed", "why"];
    let mut table = Table::new("Tasks without a result", columns.map(Column::new));
    for one in loaded {
        let why = match &one.found {
            Found::Result(_) => continue,
            Found::Failed(reason) => reason.as_str(),
            Found::Missing => "not run yet",
        };
        table.push([
            Cell::text(one.task.key.as_str()),
            Cell::text(one.task.dataset.as_str()),
            Cell::text(one.task.configuration()),
            Cell::text(one.task.split.as_deref().unwrap_or("as recorded")),
            Cell::Number(one.task.seed.to_string()),
            Cell::text(why),
        ]);
    }
    table
}
