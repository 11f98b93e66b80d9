//! Tested samples behind the scores of a study.

use taceva_core::counted;

use super::Study;

impl Study {
    /// Number of tested samples and of their clusters, as text: `80 samples in 16 clusters`; `None` without scores of prediction errors.
    pub(crate) fn tested_count(&self) -> Option<String> {
        let errors = self.scores.iter();
        let errors = errors.filter(|score| matches!(score.metric.as_str(), "mae" | "skill"));
        let n = errors.clone().map(|score| score.n).max();
        let samples = counted(n.filter(|n| *n > 0)?, "sample");
        let clusters = errors.filter_map(|score| score.interval.as_ref()?.clusters());
        Some(match clusters.max() {
            Some(clusters) => format!("{samples} in {}", counted(clusters, "cluster")),
            None => samples,
        })
    }

    /// Tested part, as text: `part test, split by-point 70/20/10, seed 1`, or `every sample`; `None` if the result does not state it. The seed of a split
    /// without random numbers is left out.
    pub(crate) fn tested_part(&self) -> Option<String> {
        let (part, split) = (self.stated("part"), self.stated("split"));
        if self.made.folds.is_some() || part == Some("all") {
            return Some("every sample".to_owned());
        }
        let is_fixed = |split: &str| {
            split.starts_with("chronological") || split == "declared" || split.contains('=')
        };
        let seed = self.stated("seed");
        let seed = seed.filter(|_| !split.is_some_and(is_fixed));
        let named = [("part", part), ("split", split), ("seed", seed)];
        let named = named
            .into_iter()
            .filter_map(|(name, text)| Some(format!("{name} {}", text?)));
        let named: Vec<String> = named.collect();
        (!named.is_empty()).then(|| named.join(", "))
    }
}
