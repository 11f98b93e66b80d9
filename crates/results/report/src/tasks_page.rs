//! Page of the scores of tasks: confused classes, curves, delays, and the samples with the greatest errors.

mod confusion;
mod curve;
mod delays;
mod worst;

use maud::{Markup, html};
use taceva_results::not_measured;
use taceva_tasks::{TaskReport, TaskScores};

use crate::html::{Document, Picture};
use crate::tasks::task_table;

/// Page of the scores of tasks as one HTML file. The first table comes from [`task_table`].
///
/// `pictures` show the samples with the greatest errors. The study of a picture is the index of its task in the report.
///
/// ```
/// use taceva_report::task_page;
/// use taceva_tasks::{Classes, TaskReport, TaskScores};
/// let mut grasp = Classes::new(["lost", "held"], Some("held"))?;
/// grasp.push("cup", "held", "lost")?;
/// let mut report = TaskReport::new("0.2.0", "by `sample`");
/// report.tasks.push(TaskScores::new("grasp", "outcome", "object").of_classes(&grasp));
/// let page = task_page("Grasps", &report, &[]);
/// assert!(page.contains("held as lost: 1 of 1"));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
pub fn task_page(title: &str, report: &TaskReport, pictures: &[Picture]) -> String {
    let badge = not_measured(report.sources.iter().map(String::as_str));
    let lead = html! { @if let Some(badge) = &badge { p.badge { (badge) } "\n" } };
    let mut document = Document::new(title, lead);
    document.section("scores", "Scores", task_table(report).html());
    let sections: [(&'static str, &'static str, Part); 4] = [
        ("confusion", "Confused classes", confusion::part),
        ("curves", "Precision and recall", curve::part),
        ("delays", "Delays of onsets", delays::part),
        ("worst", "Greatest errors", worst::table),
    ];
    for (id, title, part) in sections {
        let tasks = report.tasks.iter().enumerate();
        let parts: Vec<Markup> = tasks.filter_map(|(at, task)| part(task, at)).collect();
        if !parts.is_empty() {
            document.section(id, title, html! { @for part in &parts { (part) } });
        }
    }
    if let Some(cards) = worst::cards(report, pictures) {
        document.section("pictures", "Pictures of errors", cards);
    }
    document.finish()
}

/// Part of a section for the task at a position of the report; `None` without content.
type Part = fn(&TaskScores, usize) -> Option<Markup>;

/// Numbers of samples and clusters, for captions: `60 samples of 6 clusters by stroke`.
fn counts(task: &TaskScores) -> String {
    let Some(estimate) = task.scores.first().map(|score| &score.estimate) else {
        return String::new();
    };
    format!(
        "{} of {} by {}",
        taceva_core::counted(estimate.n, "sample"),
        taceva_core::counted(estimate.clusters, "cluster"),
        task.cluster
    )
}
