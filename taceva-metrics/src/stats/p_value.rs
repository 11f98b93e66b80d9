//! P values as text, in the same notation in every output.

/// Least p value with digits of its own.
const LEAST: f64 = 0.001;
/// Level at which a difference is shown.
const LEVEL: f64 = 0.05;

/// P value as text for a table: three decimals, or `< 0.001`. A value above 0.05 never reads as 0.050: it has as many more decimals as it needs.
///
/// ```
/// use taceva_metrics::p_value;
/// assert_eq!([0.0123, 0.25, 0.0004].map(p_value), ["0.012", "0.250", "< 0.001"]);
/// assert_eq!(p_value(0.0502), "0.0502");
/// ```
pub fn p_value(p: f64) -> String {
    if p < LEAST {
        return format!("< {LEAST}");
    }
    let texts = (3..16).map(|decimals| format!("{p:.decimals$}"));
    let mut texts = texts.filter(|text| p <= LEVEL || text.trim_end_matches('0') != "0.05");
    texts.next().unwrap_or_else(|| p.to_string())
}

/// P value as words for a sentence: `p = 0.012`, or `p < 0.001`.
///
/// ```
/// use taceva_metrics::p_words;
/// assert_eq!([0.0123, 0.0004].map(p_words), ["p = 0.012", "p < 0.001"]);
/// ```
pub fn p_words(p: f64) -> String {
    match p_value(p) {
        text if p < LEAST => format!("p {text}"),
        text => format!("p = {text}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_p_value_has_three_decimals_at_any_size() {
        let shown = [1.0, 0.25, 0.03125, 0.0123, 0.001].map(p_value);
        assert_eq!(shown, ["1.000", "0.250", "0.031", "0.012", "0.001"]);
        assert_eq!([0.000_999, 1e-20, 0.0].map(p_value), ["< 0.001"; 3]);
    }

    #[test]
    fn a_p_value_above_the_level_never_reads_as_the_level() {
        let shown = [0.05, 0.049_9, 0.050_4, 0.050_04, 0.0506].map(p_value);
        assert_eq!(shown, ["0.050", "0.050", "0.0504", "0.05004", "0.051"]);
    }
}
