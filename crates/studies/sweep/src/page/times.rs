//! Page of run times.

use taceva_report::{PagePart, PageSection, Race, RacePoint, TablesPage, race};

use super::{badge, title};
use crate::analysis::{self, Loaded};
use crate::folder::SweepFolder;
use crate::task_list::TaskList;
use crate::times::TaskTime;

/// Page of run times: time against error, with a figure of R² for each recording and channel. Its content differs between runs.
pub(crate) fn times(folder: &SweepFolder, list: &TaskList, loaded: &[Loaded<'_>]) -> String {
    let mut parts = vec![PagePart::Words(
        "The time of a task depends on the machine, its load and the content of the cache. Filled: no other configuration is both faster \
         and more accurate.".to_owned(),
    )];
    let groups = analysis::groups(loaded);
    for place in taceva_core::distinct(groups.iter().map(|group| group.place())) {
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
                    caption: "Seconds per task, including features, against R² on the test part; means over seeds.".to_owned(),
                    gain: format!("R² of {channel}"),
                    cost: "s per task".to_owned(),
                    floor: None,
                    points,
                }))));
            }
        }
    }
    TablesPage {
        title: format!("{}: times", title(list)),
        badge: badge(loaded),
        lead: vec![
            "Run times are separate from results: times.csv has one row per task.".to_owned(),
        ],
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
