//! Notation of metrics in papers.

use taceva_metrics::catalogue;

use crate::escape::latex as escape;

/// Metric in LaTeX: `MAE`, `$R^2$`, followed by its variant. A metric without a symbol keeps its name.
pub(super) fn metric(id: &str) -> String {
    let (base, variant) = match id.split_once('.') {
        Some((base, variant)) => (base, format!(", {}", escape(variant))),
        None => (id, String::new()),
    };
    let symbol = catalogue::find(base).and_then(|metric| metric.symbol);
    symbol.map_or_else(|| escape(id), |symbol| format!("{symbol}{variant}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metrics_are_set_as_in_papers_and_others_as_they_are() {
        let set = ["mae", "r2", "hysteresis.ratio", "own_metric"].map(metric);
        assert_eq!(set, ["MAE", "$R^2$", "hysteresis, ratio", "own\\_metric"]);
    }
}
