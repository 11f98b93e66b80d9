//! The pages of a sweep: results, and apart from them what they took.

use taceva_report::{
    Cell, Column, PagePart, PageSection, Race, RacePoint, Table, TablesPage, race,
};

use crate::accepted;
use crate::analysis::{self, Found, Loaded};
use crate::chosen;
use crate::collected::Collected;
use crate::decided;
use crate::effects;
use crate::folder::SweepFolder;
use crate::task_list::TaskList;
use crate::times::TaskTime;

/// The page of results; the same results give the same bytes.
pub(crate) fn results(list: &TaskList, loaded: &[Loaded<'_>], collected: &Collected) -> String {
    let channels = analysis::channels(loaded);
    let groups = analysis::groups(loaded);
    let choices = chosen::choices(&groups, &channels);
    let mut sections = Vec::new();
    let mut section = |id, title, parts| sections.push(PageSection { id, title, parts });
    let partial = groups.iter().filter(|group| !group.is_whole).count();
    let mut best = vec![PagePart::Table(chosen::table(&groups, &choices))];
    if partial > 0 {
        best.push(PagePart::Words(format!(
            "{partial} of {} configurations lack a result for some seed and take no part in the choice.",
            groups.len()
        )));
    }
    section("best", "Best of each question", best);
    if !collected.units.is_empty() {
        section(
            "units",
            "Units",
            vec![PagePart::Table(accepted::table(&collected.units))],
        );
    }
    let effects = effects::table(loaded, list, &channels);
    section(
        "effects",
        "Effect of each setting",
        vec![PagePart::Table(effects)],
    );
    let decided = decided::table(&groups, &choices);
    let count = format!("{} pairs", decided.rows.len());
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
        "{} tasks: {} scored, {} failed, {} not carried out.",
        list.tasks.len(),
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

/// That nothing, or not everything, was measured.
fn badge(loaded: &[Loaded<'_>]) -> Option<String> {
    let results = loaded.iter().filter_map(Loaded::result);
    let drawn = results.map(|result| matches!(result.source.as_str(), "simulated" | "synthetic"));
    let drawn: Vec<bool> = drawn.collect();
    let words = match drawn.iter().filter(|is_drawn| **is_drawn).count() {
        0 => return None,
        count if count == drawn.len() => {
            "Nothing here was measured: the samples are simulated or synthetic."
        }
        _ => "Not everything here was measured: some of the samples are simulated or synthetic.",
    };
    Some(words.to_owned())
}

/// The tasks without a result.
fn left(loaded: &[Loaded<'_>]) -> Table {
    let columns = ["task", "recording", "model", "split", "seed", "why"];
    let mut table = Table::new("Tasks without a result", columns.map(Column::new));
    for one in loaded {
        let why = match &one.found {
            Found::Result(_) => continue,
            Found::Failed(reason) => reason.as_str(),
            Found::Missing => "not carried out yet",
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

/// The page of times, which no two runs agree on: run time against error, a figure for each recording and channel with R².
pub(crate) fn times(folder: &SweepFolder, list: &TaskList, loaded: &[Loaded<'_>]) -> String {
    let mut parts = vec![PagePart::Words(
        "What a task took depends on the machine, its load and on what was in the cache before. Filled: no other configuration is both faster and more accurate.".to_owned(),
    )];
    let groups = analysis::groups(loaded);
    let mut places: Vec<(&str, Option<&str>)> = Vec::new();
    for group in &groups {
        if !places.contains(&group.place()) {
            places.push(group.place());
        }
    }
    for place in places {
        for channel in analysis::channels(loaded) {
            let of_place = groups.iter().filter(|group| group.place() == place);
            let points = of_place.filter_map(|group| {
                let gains = group.values("r2", &channel);
                let seconds = group
                    .results
                    .iter()
                    .filter_map(|(_, result)| TaskTime::read(folder, &result.key));
                let seconds: Vec<f64> = seconds.map(|time| time.seconds).collect();
                let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
                (!gains.is_empty() && !seconds.is_empty()).then(|| RacePoint {
                    name: group.configuration.clone(),
                    gain: mean(&gains),
                    cost: mean(&seconds).max(1e-3),
                    is_on_front: false,
                })
            });
            let mut points: Vec<RacePoint> = points.collect();
            mark_front(&mut points);
            if points.len() > 1 {
                let split = place.1.unwrap_or("split as recorded");
                parts.push(PagePart::Figure(Box::new(race(&Race {
                    title: format!("{channel} of {}, {split}", place.0),
                    caption: "Seconds of a task, features included, against R² on the test part, means over seeds.".to_owned(),
                    gain: format!("R² of {channel}"),
                    cost: "s a task".to_owned(),
                    floor: None,
                    points,
                }))));
            }
        }
    }
    TablesPage {
        title: format!("{}: times", title(list)),
        badge: badge(loaded),
        lead: vec!["Run times stand apart from results: times.csv has a row a task.".to_owned()],
        sections: vec![PageSection {
            id: "times",
            title: "Run time against error",
            parts,
        }],
    }
    .html()
}

fn mark_front(points: &mut [RacePoint]) {
    let all: Vec<[f64; 2]> = points
        .iter()
        .map(|point| [point.gain, point.cost])
        .collect();
    for point in points {
        let is_beaten = |other: &[f64; 2]| {
            let [gain, cost] = *other;
            gain >= point.gain && cost <= point.cost && (gain > point.gain || cost < point.cost)
        };
        point.is_on_front = !all.iter().any(is_beaten);
    }
}
