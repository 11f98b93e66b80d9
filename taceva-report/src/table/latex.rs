//! For papers: a booktabs table, a row a score, a column a study.

use super::notation::{directed, metric};
use super::{ScoreCell, ScoreTable};
use crate::escape::latex as escape;

/// A table as LaTeX with booktabs. A value is bold only where it is shown to be better than all others of its row: the table says so below.
pub fn latex(table: &ScoreTable, caption: &str) -> String {
    let columns = table.names.len();
    let names: Vec<String> = table.names.iter().map(|name| escape(name)).collect();
    let mut out = String::from("% needs \\usepackage{booktabs}\n\\begin{table}\n");
    out += &format!("  \\caption{{{}}}\n", escape(caption));
    out += &format!("  \\begin{{tabular}}{{lll{}}}\n", "r".repeat(columns));
    out += "    \\toprule\n";
    out += &format!(
        "    metric & channel & unit & {} \\\\\n    \\midrule\n",
        names.join(" & ")
    );
    let mut last = "";
    for row in &table.rows {
        let metric = if row.metric == last {
            ""
        } else {
            row.metric.as_str()
        };
        if !last.is_empty() && !metric.is_empty() {
            out += "    \\addlinespace\n";
        }
        last = &row.metric;
        let cells: Vec<String> = row
            .cells
            .iter()
            .map(|cell| self::cell(cell.as_ref()))
            .collect();
        let unit = match row.unit.symbol() {
            "1" => String::new(),
            symbol => escape(symbol),
        };
        out += &format!(
            "    {} & {} & {unit} & {} \\\\\n",
            directed(metric, &self::metric(metric)),
            symbol(&row.channel),
            cells.join(" & ")
        );
        let intervals: Vec<String> = row
            .cells
            .iter()
            .map(|cell| interval(cell.as_ref()))
            .collect();
        if intervals.iter().any(|interval| !interval.is_empty()) {
            out += &format!("     & & & {} \\\\\n", intervals.join(" & "));
        }
    }
    out += "    \\bottomrule\n  \\end{tabular}\n";
    if columns > 1 {
        out += "\n  \\footnotesize Bold: better than every other sensor that takes part in verdicts, at a level of 5\\,\\% after Holm's adjustment.\n";
    }
    out += "\\end{table}\n";
    out
}

pub(super) fn cell(cell: Option<&ScoreCell>) -> String {
    let Some(cell) = cell.filter(|cell| !cell.printed.value.is_empty()) else {
        return "--".to_owned();
    };
    let value = number(&cell.printed.value);
    match cell.is_best {
        true => format!("\\textbf{{{value}}}"),
        false => value,
    }
}

fn interval(cell: Option<&ScoreCell>) -> String {
    let ends = cell.and_then(|cell| cell.printed.interval.as_ref());
    let ends = ends.map(|[low, high]| format!("[{}, {}]", number(low), number(high)));
    let remark = cell.and_then(ScoreCell::remark);
    let said: Vec<String> = ends
        .into_iter()
        .chain(remark.map(|remark| escape(&remark)))
        .collect();
    match said.is_empty() {
        true => String::new(),
        false => format!("\\scriptsize {}", said.join(", ")),
    }
}

/// A printed number as papers set it: a minus as wide as a plus, and `2.3e-7` with its power of ten; what is no number is escaped.
///
/// ```
/// assert_eq!(taceva_report::latex_number("-0.5"), "$-0.5$");
/// assert_eq!(taceva_report::latex_number("2.3e-7"), "$2.3\\times 10^{-7}$");
/// ```
pub fn number(text: &str) -> String {
    let plain = text.replace('−', "-");
    if plain.parse::<f64>().is_err() {
        return escape(text);
    }
    match plain.split_once('e') {
        Some((digits, power)) => format!("${digits}\\times 10^{{{power}}}$"),
        None if plain.starts_with('-') => format!("${plain}$"),
        None => plain,
    }
}

/// The symbol of a channel, `Fxy` as `$F_{xy}$`; other names as they are.
///
/// ```
/// assert_eq!(taceva_report::latex_symbol("Fxy"), "$F_{xy}$");
/// assert_eq!(taceva_report::latex_symbol("shear_x"), "shear\\_x");
/// ```
pub fn symbol(name: &str) -> String {
    let axes = name
        .strip_prefix('P')
        .map(|axes| ('P', axes))
        .or_else(|| name.strip_prefix('F').map(|axes| ('F', axes)));
    match axes {
        Some((quantity, axes)) if ["x", "y", "z", "xy"].contains(&axes) => {
            format!("${quantity}_{{{axes}}}$")
        }
        _ => escape(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_symbols_and_other_names_words() {
        assert_eq!(
            [symbol("Fxy"), symbol("Pz"), symbol("shear_x")],
            ["$F_{xy}$", "$P_{z}$", "shear\\_x"]
        );
    }

    #[test]
    fn numbers_are_set_and_words_escaped() {
        let texts = ["0.25", "−0.25", "-1.5e-9", "50 %", "–", "inf_1"];
        assert_eq!(
            texts.map(number),
            [
                "0.25",
                "$-0.25$",
                "$-1.5\\times 10^{-9}$",
                "50 \\%",
                "--",
                "inf\\_1"
            ]
        );
    }
}
