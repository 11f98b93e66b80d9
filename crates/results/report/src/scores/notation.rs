//! Metrics as papers of the field write them.

use crate::escape::latex as escape;

/// Names in commands, and symbols in papers.
const SYMBOLS: [(&str, &str); 20] = [
    ("skill", "skill"),
    ("mae", "MAE"),
    ("rmse", "RMSE"),
    ("bias", "bias"),
    ("r2", "$R^2$"),
    ("smape", "sMAPE"),
    ("smape_gated", "sMAPE, gated"),
    ("mae_euclid", "MAE, Euclidean"),
    ("sr", "SR"),
    ("sensitivity", "$S$"),
    ("uniformity", "$U$"),
    ("r_spatial", "$R_{\\mathrm{spatial}}$"),
    ("r_light", "$R_{\\mathrm{light}}$"),
    ("repeatability", "$\\sigma_{\\mathrm{rep}}$"),
    ("hysteresis", "hysteresis"),
    ("inter_sensor", "between units"),
    ("minimum_detectable_force", "$F_{\\min}$"),
    ("signal_to_repeatability", "signal to repeatability"),
    ("linearity", "linearity"),
    ("bias_level", "bias by level"),
];

/// A metric as LaTeX: `MAE`, `$R^2$`; a variant after it, and what has no symbol as it is.
pub(super) fn metric(id: &str) -> String {
    let (base, variant) = match id.split_once('.') {
        Some((base, variant)) => (base, format!(", {}", escape(variant))),
        None => (id, String::new()),
    };
    let known = SYMBOLS.iter().find(|(known, _)| *known == base);
    known.map_or_else(|| escape(id), |(_, symbol)| format!("{symbol}{variant}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metrics_are_set_as_in_papers_and_others_as_they_are() {
        let set = ["mae", "r2", "hysteresis.ratio", "own_metric"].map(metric);
        assert_eq!(set, ["MAE", "$R^2$", "hysteresis, ratio", "own\\_metric"]);
    }

    #[test]
    fn every_symbol_is_of_a_metric_that_there_is() {
        for (id, _) in SYMBOLS {
            let is_known = taceva_metrics::catalogue::find(id).is_some();
            assert!(is_known, "{id}");
        }
    }
}
