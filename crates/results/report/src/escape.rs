//! Escapes external text. Names of sensors, ids of samples and reasons may contain any character.

use maud::html;
use taceva_core::is_obeyed;
pub use taceva_core::markdown;

/// Escapes text for SVG elements and quoted attributes. Unprintable characters become `U+FFFD`.
pub(crate) fn svg(text: &str) -> String {
    html! { (obeyed_replaced(text)) }.into_string()
}

/// Replaces control characters, except line ends and tabs, by `U+FFFD`.
pub(crate) fn obeyed_replaced(text: &str) -> String {
    let is_replaced = |letter| is_obeyed(letter) && !matches!(letter, '\n' | '\t');
    text.replace(is_replaced, "\u{fffd}")
}

/// LaTeX command for a letter that the fonts of pdflatex lack. LuaLaTeX and XeLaTeX print the letter, or its code point if the font lacks the letter. Each
/// table that uses the command also defines it.
pub(crate) const LETTER: &str = "\\tacevaletter";
/// Definition of [`LETTER`].
pub(crate) const LETTER_DEFINITION: &str = "% letters beyond Latin: LuaLaTeX or XeLaTeX with a font that has them; elsewhere their code points\n\
\\providecommand{\\tacevaletter}[2]{\\ifdefined\\Umathchar\\iffontchar\\font\"#1 #2\\else U+#1\\fi\\else U+#1\\fi}\n";

/// Escapes text for LaTeX.
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
            // The default font has no straight quotation mark.
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
            '‡' => escaped.push_str("\\ddag{}"),
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
            _ if is_set_everywhere(character) => escaped.push(character),
            _ => {
                let point = u32::from(character);
                escaped.push_str(&format!("{LETTER}{{{point:04X}}}{{{character}}}"));
            }
        }
    }
    escaped
}

/// True for letters that the default fonts of every engine contain: ASCII, and accented letters of Latin-1 and Latin Extended-A.
pub(crate) fn is_set_everywhere(letter: char) -> bool {
    const ABSENT: &str = "«»ÐÞðþĄąĐđĘęĦħĮįĸĿŀŉŊŋŦŧŲųſ";
    let is_latin = matches!(letter, ' '..='~' | '\u{a1}'..='\u{17f}') || "‘’“”—•".contains(letter);
    is_latin && !ABSENT.contains(letter)
}

/// Text as a quoted string of TOML.
pub(crate) fn toml_string(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Escapes text for a terminal, by [`taceva_core::shown`].
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
    fn letters_that_pdflatex_lacks_are_set_by_a_command_and_accents_as_they_are() {
        assert_eq!(latex("é ő"), "é ő");
        assert_eq!(
            latex("名đ"),
            "\\tacevaletter{540D}{名}\\tacevaletter{0111}{đ}"
        );
    }

    #[test]
    fn no_name_controls_a_terminal() {
        assert_eq!(terminal("a\u{1b}[2J\u{202e}b"), "a\\u{1b}[2J\\u{202e}b");
    }
}
