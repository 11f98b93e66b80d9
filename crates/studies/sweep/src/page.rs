//! Pages of a sweep: a page of results and a page of run times.

mod label_scores;
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
    let mut sections = match list.is_of_labels() {
        true => {
            let scores = PagePart::Table(label_scores::table(loaded));
            vec![section("scores", "Scores of each task", vec![scores])]
        }
        false => of_channels(list, loaded),
    };
    if !collected.units.is_empty() {
        let units = PagePart::Table(units::table(&collected.units));
        // After the first section: the best configurations or the scores.
        sections.insert(1, section("units", "Units", vec![units]));
    }
    let left = left(loaded);
    if !left.rows.is_empty() {
        let left = PagePart::Table(left);
        sections.push(section("failed", "Without a result", vec![left]));
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

fn section(id: &'static str, title: &'static str, parts: Vec<PagePart>) -> PageSection {
    PageSection { id, title, parts }
}

/// Best configurations, effects of settings, and compared configurations of a sweep over channels.
fn of_channels(list: &TaskList, loaded: &[Loaded<'_>]) -> Vec<PageSection> {
    let channels = analysis::channels(loaded);
    let groups = analysis::groups(loaded);
    let choices = choices::choices(&groups, &channels);
    let partial = groups.iter().filter(|group| !group.is_whole).count();
    let mut best = vec![PagePart::Table(choices::table(&groups, &choices))];
    if partial > 0 {
        best.push(PagePart::Words(format!(
            "{partial} of {} configurations lack a result for some seed. Choices are made among configurations with results for the same seeds. Other configurations are compared with the chosen one on shared seeds.",
            groups.len()
        )));
    }
    let effects = PagePart::Table(effects::table(loaded, list, &channels));
    let decided = decisions::table(&groups, &choices);
    let count = counted(decided.rows.len(), "pair");
    let decided = PagePart::Folded("compared-all", count, decided);
    vec![
        section("best", "Best of each question", best),
        section("effects", "Effect of each setting", vec![effects]),
        section("compared", "Compared", vec![decided]),
    ]
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
            Cell::text(one.task.title()),
            Cell::text(one.task.division()),
            Cell::Number(one.task.seed.to_string()),
            Cell::text(why),
        ]);
    }
    table
}
