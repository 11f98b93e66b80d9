//! Escapes foreign text: names of sensors, ids of samples and reasons may contain anything.

use maud::html;
use taceva_core::is_obeyed;

/// Escaped text for SVG elements and quoted attributes. Unprintable characters become `U+FFFD`.
pub(crate) fn svg(text: &str) -> String {
    html! { (obeyed_replaced(text)) }.into_string()
}

/// Replaces control characters, except line ends and tabs, by `U+FFFD`.
pub(crate) fn obeyed_replaced(text: &str) -> String {
    let is_replaced = |letter| is_obeyed(letter) && !matches!(letter, '\n' | '\t');
    text.replace(is_replaced, "\u{fffd}")
}

/// Escaped text for LaTeX.
pub fn latex(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '<' => escaped.push_str("\\textless{}"),
            '>' => escaped.push_str("\\textgreater{}"),
            '|' => escaped.push_str("\\textbar{}"),
            // The plain font has no straight quotation mark.
            '"' => escaped.push_str("''"),
            '{' | '}' | '$' | '&' | '#' | '_' | '%' => escaped.extend(['\\', character]),
            '–' => escaped.push_str("--"),
            '…' => escaped.push_str("\\dots{}"),
            '²' => escaped.push_str("$^2$"),
            '³' => escaped.push_str("$^3$"),
            '·' => escaped.push_str("$\\cdot$"),
            '×' => escaped.push_str("$\\times$"),
            '±' => escaped.push_str("$\\pm$"),
            '−' => escaped.push_str("$-$"),
            '†' => escaped.push_str("\\dag{}"),
            '≤' => escaped.push_str("$\\leq$"),
            '≥' => escaped.push_str("$\\geq$"),
            '↑' => escaped.push_str("$\\uparrow$"),
            '↓' => escaped.push_str("$\\downarrow$"),
            '∞' => escaped.push_str("$\\infty$"),
            '≈' => escaped.push_str("$\\approx$"),
            '→' => escaped.push_str("$\\to$"),
            'µ' | 'μ' => escaped.push_str("$\\mu$"),
            'σ' => escaped.push_str("$\\sigma$"),
            'ε' => escaped.push_str("$\\varepsilon$"),
            '\n' | '\r' | '\t' => escaped.push(' '),
            _ if is_obeyed(character) => {}
            _ => escaped.push(character),
        }
    }
    escaped
}

/// Escaped text for a cell of a Markdown table: one line without markup.
pub fn markdown(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '\n' | '\r' | '\t' => escaped.push(' '),
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '\\' | '|' | '*' | '_' | '`' | '[' | ']' | '~' | '#' | '!' => {
                escaped.extend(['\\', letter]);
            }
            _ if is_obeyed(letter) => {}
            _ => escaped.push(letter),
        }
    }
    escaped
}

/// Escaped text for a terminal, by [`taceva_core::shown`].
pub fn terminal(text: &str) -> String {
    taceva_core::shown(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_that_latex_reads_specially_is_escaped() {
        assert_eq!(
            latex("a_b 5 % {x} \\ ~ ^ $ & #"),
            "a\\_b 5 \\% \\{x\\} \\textbackslash{} \\textasciitilde{} \\textasciicircum{} \\$ \\& \\#"
        );
    }

    #[test]
    fn no_name_controls_a_terminal() {
        assert_eq!(terminal("a\u{1b}[2J\u{202e}b"), "a\\u{1b}[2J\\u{202e}b");
    }

    #[test]
    fn a_markdown_cell_stays_a_cell() {
        assert_eq!(markdown("a|b\n<i>*x*"), "a\\|b &lt;i>\\*x\\*");
    }
}
