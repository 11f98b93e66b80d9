//! Methods paragraph for a paper, and citations.

mod equipment;
mod statistics;

use std::collections::{BTreeMap, BTreeSet};

use maud::{Markup, html};
use taceva_core::{counted, distinct};

use super::sensor_summary::{counted_span, points, span, whole};
use crate::devices::device_table;
use crate::markup::{heads, scroll};
use crate::names::{listed, names, noun};
use crate::results::Study;
use crate::scores::ScoreTable;
use crate::short_digests::short_digests;
use taceva_results::Interval;

/// Citation of the TacEva study, which defined the metrics, as its publisher prints it.
const STUDY: &str = "@article{taceva-study,\n  author  = {Cong, Qingzheng and Oh, Steven and Fan, Wen and Luo, Shan and Althoefer, Kaspar and Zhang, Dandan},\n  title   = {{TacEva}: A Performance Evaluation Framework for Vision-Based Tactile Sensors},\n  journal = {Advanced Intelligent Systems},\n  year    = {2026},\n  doi     = {10.1002/aisy.202501179}\n}";

/// Paragraph and BibTeX entries, each with a copy button, and tables of the sensors and of their devices.
pub(super) fn section(studies: &[Study], table: &ScoreTable) -> Markup {
    let paragraph = html! { p id="methods-text" { (paragraph(studies, table)) } };
    let entries = html! { pre id="bibtex-text" tabindex="0" { (bibtex(studies)) } };
    html! {
        (copied("methods-text", "Methods", &paragraph))
        (copied("bibtex-text", "BibTeX", &entries))
        (sensors(studies))
        @if let Some(table) = device_table(studies) { (table.html()) }
    }
}

/// Text with a copy button. The script of the page makes the button visible.
fn copied(id: &str, what: &str, body: &Markup) -> Markup {
    html! {
        div.copied { button.act type="button" data-copy=(id) hidden { "Copy " (what) } "\n" (body) } "\n"
    }
}

/// Text of the methods paragraph for a paper.
fn paragraph(studies: &[Study], table: &ScoreTable) -> String {
    let mut out = format!(
        "We evaluated {} ({}) with TacEva {}.",
        evaluated(studies),
        listed(&names(studies)),
        listed(
            &values(studies, "taceva").unwrap_or_else(|| vec!["of an unknown version".to_owned()])
        )
    );
    out += &origin(studies);
    out += &equipment::equipment(studies);
    out += &joined(studies);
    out += &pressed(studies);
    out += &divided(studies);
    out += &model(studies);
    out += &gratings(studies);
    out += &statistics::statistics(studies, table);
    out += &scope(studies);
    out + &places(studies)
}

/// Number of results, and number of sensors if the numbers differ.
fn evaluated(studies: &[Study]) -> String {
    let units = studies
        .iter()
        .map(|study| (&study.sensor, &study.serial, &study.gel));
    let units = units.collect::<BTreeSet<_>>().len();
    match units == studies.len() {
        true => counted(units, "tactile sensor"),
        false => format!(
            "{} of {}",
            counted(studies.len(), "result"),
            counted(units, "tactile sensor")
        ),
    }
}

/// Sentence on the origin of the samples.
fn origin(studies: &[Study]) -> String {
    let unmeasured = studies.iter().filter(|study| study.is_simulated());
    let sources: Vec<&str> = unmeasured.map(|study| study.source.as_str()).collect();
    let kinds: BTreeSet<&str> = sources.iter().copied().collect();
    let kinds = kinds.into_iter().collect::<Vec<_>>().join(" and ");
    let published = studies
        .iter()
        .filter(|study| study.source == "published")
        .count();
    let mut out = match (sources.len(), studies.len() - sources.len()) {
        (0, _) => String::new(),
        (_, 0) => format!(" All samples are {kinds}, none was measured on hardware."),
        (some, _) => format!(
            " The samples of {} are {kinds} and were not measured on hardware.",
            counted(some, noun(studies))
        ),
    };
    if published > 0 {
        out += &format!(
            " The numbers of {} are published ones.",
            counted(published, noun(studies))
        );
    }
    out
}

/// Sentence on the tables joined by imports, from the notes of the results.
fn joined(studies: &[Study]) -> String {
    let notes = studies.iter().flat_map(|study| &study.notes);
    let joins = notes.filter_map(|note| note.split_once("import: table "));
    let joins: BTreeSet<&str> = joins
        .map(|(_, words)| words)
        .filter(|words| words.contains(" joined by "))
        .collect();
    match joins.is_empty() {
        true => String::new(),
        false => {
            let joins: Vec<&str> = joins.into_iter().collect();
            format!(" The import joined tables ({}).", joins.join("; "))
        }
    }
}

/// Sentence on contact points without a name in the recording, from the notes of the results.
fn places(studies: &[Study]) -> String {
    let mut notes = studies.iter().flat_map(|study| &study.notes);
    match notes.any(|note| note.contains("names no places")) {
        true => " It is unknown if the tested places were seen in training, because the recording names no places.".to_owned(),
        false => String::new(),
    }
}

/// Number of presses in the recordings, and number of contact points in the scored samples, as text.
fn pressed(studies: &[Study]) -> String {
    let presses = counted_span(studies, "press", |study| whole(study.made.presses));
    let points = counted_span(studies, "contact point", points);
    let presses = presses.map(|presses| {
        format!(" A protocol made {presses} for each recording, including those without a usable sample.")
    });
    let points = points.map(|points| format!(" Scored samples lie at {points}."));
    presses.into_iter().chain(points).collect()
}

/// Sentence on the split of the samples, with the sizes of its parts.
fn divided(studies: &[Study]) -> String {
    let Some(splits) = values(studies, "split") else {
        return String::new();
    };
    let seeds = values(studies, "seed").map(|seeds| format!("seed {}", listed(&seeds)));
    let folds = studies.iter().map(|study| study.made.folds.clone());
    if let Some(mut folds) = folds.collect::<Option<Vec<String>>>() {
        folds.sort();
        folds.dedup();
        let seeds = seeds.map_or_else(String::new, |seeds| format!(", {seeds}"));
        return format!(
            " Each sample was held out once, and predicted by a model that was fitted without its group ({}; split {}{seeds}).",
            listed(&folds),
            listed(&splits)
        );
    }
    let mut out = format!(" Samples were divided by the split {}", listed(&splits));
    if let Some(seeds) = seeds {
        out += &format!(" ({seeds})");
    }
    let all = studies.iter().flat_map(|study| &study.made.samples);
    // Left-out samples of a protocol belong to its other parts, for other metrics.
    let all = all.filter(|(name, _)| name != "left_out");
    let names = distinct(all.map(|(name, _)| name.as_str()));
    let part = |name: &&str| {
        let of = |study: &Study| {
            let found = study.made.samples.iter().find(|(part, _)| part == name)?;
            whole(found.1)
        };
        Some(format!("{} {}", span(studies, of)?, name.replace('_', " ")))
    };
    let parts: Vec<String> = names.iter().filter_map(part).collect();
    if !parts.is_empty() {
        out += &format!(" into {} samples", listed(&parts));
    }
    let unused = |study: &Study| {
        let samples = study.made.samples.iter();
        let mut samples = samples.filter(|_| study.made.presses == 0);
        whole(samples.find(|(name, _)| name == "left_out")?.1)
    };
    if let Some(unused) = counted_span(studies, "sample", unused) {
        out += &format!(", with {unused} in no part");
    }
    out + "."
}

/// Sentence on the models, with the settings common to each name.
fn model(studies: &[Study]) -> String {
    let mut models: BTreeMap<&str, Vec<&Study>> = BTreeMap::new();
    for study in studies {
        if let Some(name) = &study.made.model {
            models.entry(name).or_default().push(study);
        }
    }
    let sentence = |(name, of): (&str, Vec<&Study>)| {
        let (mut shared, mut own) = (Vec::new(), BTreeSet::new());
        for (key, value) in of.iter().flat_map(|study| &study.made.settings) {
            let setting = (key.clone(), value.clone());
            match of
                .iter()
                .all(|study| study.made.settings.contains(&setting))
            {
                true if !shared.contains(&setting) => shared.push(setting),
                true => {}
                false => {
                    own.insert(key.as_str());
                }
            }
        }
        let shared: Vec<String> = shared
            .iter()
            .map(|(key, value)| format!("{key} = {value}"))
            .collect();
        let mut words = format!(" Labels were predicted by the model {name}");
        if of.len() < studies.len() {
            let names: Vec<String> = of.iter().map(|study| study.sensor.clone()).collect();
            words += &format!(" for {}", listed(&names));
        }
        if !shared.is_empty() {
            words += &format!(" ({})", shared.join("; "));
        }
        if !own.is_empty() {
            let own: Vec<String> = own.into_iter().map(str::to_owned).collect();
            words += &format!(", with {} chosen for each sensor", listed(&own));
        }
        let chosen = of.iter().filter_map(|study| study.made.chosen_by.clone());
        let chosen: BTreeSet<String> = chosen.collect();
        if !chosen.is_empty() {
            let chosen: Vec<String> = chosen.into_iter().collect();
            words += &format!("; its fit chose {}", listed(&chosen));
        }
        words + "."
    };
    let sentences: String = models.into_iter().map(sentence).collect();
    match sentences.is_empty() {
        true => sentences,
        false => sentences + &unseen(studies),
    }
}

/// Sentence which states that scored samples were unseen in training, with the studies for which this is false.
fn unseen(studies: &[Study]) -> String {
    let seen = studies.iter().filter_map(|study| {
        let part = study.made.seen_part.as_ref()?;
        Some(format!("{} (part {part})", study.sensor))
    });
    let seen: Vec<String> = seen.collect();
    let predicted = match seen.is_empty() {
        true => " Every score of predictions uses samples that the model had not seen;".to_owned(),
        false => format!(
            " Scores of {} use samples that the model had seen, so they are not a test;",
            listed(&seen)
        ),
    };
    predicted
        + " scores without predictions, such as sensitivity, uniformity and hysteresis, use all samples that they apply to."
}

/// Sentence on the limits of validity of intervals and p values.
fn scope(studies: &[Study]) -> String {
    let own = studies.iter();
    let own = own.filter(|study| study.source != "published" && !study.scores.is_empty());
    let own: Vec<&Study> = own.collect();
    if own.is_empty() {
        return String::new();
    }
    let models = match own.iter().all(|study| study.made.folds.is_some()) {
        true => "with models fitted in the same way",
        false => "with the same trained models",
    };
    let what = match studies.len() {
        1 => "Intervals",
        _ => "Intervals and p values",
    };
    // Tests of results with several seeds add the variance between trainings.
    let trainings = match own.iter().any(|study| study.over_seeds.is_some()) {
        true => ", and intervals do not include that between trainings",
        false => " and trainings",
    };
    format!(
        " {what} apply to other {} on the same units {models}; they do not include the variation between units{trainings}.",
        clusters(studies)
    )
}

/// Plural name of the clusters by which intervals are computed: `contact points`, `groups by object`, `samples`.
pub(super) fn clusters(studies: &[Study]) -> String {
    let are_samples = |study: &Study| {
        let intervals = study.scores.iter();
        let intervals = intervals.filter_map(|score| score.interval.as_ref());
        let mut methods = intervals.filter_map(Interval::method);
        methods.any(|method| method.contains("samples taken as independent"))
    };
    let kind = |study: &Study| match study.clustered_by() {
        Some("block of time") => "blocks of time".to_owned(),
        Some(group) => format!("groups by {group}"),
        None if are_samples(study) => "samples".to_owned(),
        None => "contact points".to_owned(),
    };
    let mut kinds: Vec<String> = studies.iter().map(kind).collect();
    kinds.sort();
    kinds.dedup();
    listed(&kinds)
}

/// Sentence on the prediction of grating spacings, from the notes of the results.
fn gratings(studies: &[Study]) -> String {
    let notes = studies.iter().flat_map(|study| &study.notes);
    let ways: BTreeSet<&str> = notes.filter_map(|note| note.strip_prefix("sr: ")).collect();
    let sentence = |way: &str| {
        let mut letters = way.chars();
        let first = letters.next().map(|first| first.to_uppercase().to_string());
        format!(" {}{}.", first.unwrap_or_default(), letters.as_str())
    };
    ways.into_iter().map(sentence).collect()
}

/// Distinct values of a provenance entry, in the order of the studies; `None` if no study has the entry.
fn values(studies: &[Study], name: &str) -> Option<Vec<String>> {
    let mut values: Vec<String> = Vec::new();
    for (_, value) in studies
        .iter()
        .flat_map(|study| &study.provenance)
        .filter(|(known, _)| known == name)
    {
        if !values.contains(value) {
            values.push(value.clone());
        }
    }
    (!values.is_empty()).then_some(values)
}

/// BibTeX entries of the program, the TacEva study, and the sources of published numbers.
fn bibtex(studies: &[Study]) -> String {
    let versions = values(studies, "taceva");
    let version = versions.map_or_else(
        || env!("CARGO_PKG_VERSION").to_owned(),
        |all| all.join(", "),
    );
    let mut entries = vec![
        format!(
            "@software{{taceva,\n  title   = {{{{TacEva}}: how well does a vision-based tactile sensor measure?}},\n  version = {{{}}}\n}}",
            plain(&version)
        ),
        STUDY.to_owned(),
    ];
    let sources = values(studies, "source").unwrap_or_default();
    let misc = sources
        .iter()
        .enumerate()
        .map(|(at, text)| format!("@misc{{source{},\n  note = {{{}}}\n}}", at + 1, plain(text)));
    entries.extend(misc);
    entries.join("\n\n")
}

/// Text with the special characters of BibTeX replaced.
fn plain(text: &str) -> String {
    text.replace(['{', '}', '\\', '"', '%', '#', '$', '~', '^'], " ")
        .replace('&', "and")
}

/// Table of the sensors.
fn sensors(studies: &[Study]) -> Markup {
    let split = |study: &Study| {
        let mut known = study.provenance.iter();
        let split = known.find(|(name, _)| name == "split");
        split.map_or_else(|| "–".to_owned(), |(_, split)| split.clone())
    };
    let table = html! {
        table {
            caption { "Sensors" }
            thead { tr { (heads(["sensor", "serial", "gel", "samples", "model", "split"])) } }
            tbody {
                @for (study, name) in studies.iter().zip(names(studies)) {
                    tr {
                        th scope="row" { (name) } td.wrap { (study.serial) } td.wrap { (short_digests(&study.gel)) } td { (study.source) }
                        td.wrap { (study.made.model.as_deref().unwrap_or("–")) } td.wrap { (split(study)) }
                    } "\n"
                }
            }
        }
    };
    scroll("Sensors", &table)
}
