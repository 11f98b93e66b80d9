//! Scores of one dataset whose splits left out different groups, which give no verdict.

use taceva_metrics::Sides;

use crate::results::Study;

/// Reason why two results of one dataset give no verdict: their splits keep different samples together.
pub(super) fn barred(studies: Sides<&Study>, names: Sides<&str>) -> Option<String> {
    let stated = |study: &Study, key: &str| {
        let found = study.provenance.iter().find(|(name, _)| name == key);
        found.map(|(_, text)| text.clone())
    };
    let is_one_dataset = stated(studies.a, "dataset")? == stated(studies.b, "dataset")?;
    let [a, b] = [stated(studies.a, "split")?, stated(studies.b, "split")?];
    (is_one_dataset && kept_together(&a) != kept_together(&b)).then(|| {
        format!(
            "the splits differ: {} has `{a}`, and {} has `{b}`; evaluate both with one --split",
            names.a, names.b
        )
    })
}

/// The groups of a split without its number of folds, its shares and its named parts.
fn kept_together(split: &str) -> &str {
    let shares = split.rsplit_once(' ');
    let shares = shares.filter(|(_, last)| last.split('/').count() == 3);
    let text = shares.map_or(split, |(text, _)| text);
    let text = match text.split_once(' ') {
        Some((word, by)) if word == "loo" || word.starts_with("cv:") => by,
        _ => text,
    };
    text.split('=').next().unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folds_and_shares_do_not_change_what_is_kept_together() {
        for (split, expected) in [
            ("cv:5 by-point", "by-point"),
            ("by-point 70/20/10", "by-point"),
            ("loo by-column:object", "by-column:object"),
            (
                "by-column:object=train:a,b;test:c 70/20/10",
                "by-column:object",
            ),
            (
                "leave-one-recording-out 70/20/10",
                "leave-one-recording-out",
            ),
            ("declared", "declared"),
        ] {
            assert_eq!(kept_together(split), expected);
        }
    }
}
