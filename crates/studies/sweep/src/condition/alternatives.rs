//! Splits a condition at its operators: ` and `, which has precedence, and ` or `.

use super::term::Term;

/// Terms of each alternative.
pub(super) fn alternatives(text: &str) -> Result<Vec<Vec<Term>>, String> {
    let mut alternatives = vec![Vec::new()];
    for (joint, term) in pieces(text) {
        if joint == Joint::Or {
            alternatives.push(Vec::new());
        }
        if let Some(terms) = alternatives.last_mut() {
            terms.push(Term::parse(term)?);
        }
    }
    Ok(alternatives)
}

/// Operator before a term.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Joint {
    And,
    Or,
}

/// Text of each term, with the operator before the term. A quoted operator is part of a value.
fn pieces(text: &str) -> Vec<(Joint, &str)> {
    let mut pieces = Vec::new();
    let (mut joint, mut start, mut quote) = (Joint::And, 0, None);
    for (at, letter) in text.char_indices() {
        match (quote, letter) {
            (None, '"' | '\'') => quote = Some(letter),
            (Some(open), letter) if open == letter => quote = None,
            (None, ' ') if at >= start => {
                let rest = &text[at..];
                let next = [(" and ", Joint::And), (" or ", Joint::Or)];
                let found = next.into_iter().find(|(word, _)| rest.starts_with(word));
                if let Some((word, next)) = found {
                    pieces.push((joint, &text[start..at]));
                    joint = next;
                    // The space after the operator may also begin the next operator.
                    start = at + word.len();
                }
            }
            _ => {}
        }
    }
    pieces.push((joint, text.get(start..).unwrap_or_default()));
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<Vec<String>> {
        let alternatives = alternatives(text).expect(text);
        let word = |term: &Term| {
            let sign = if term.is_equal { "=" } else { "!=" };
            format!("{}{sign}{}", term.name, term.value)
        };
        alternatives
            .iter()
            .map(|terms| terms.iter().map(word).collect())
            .collect()
    }

    #[test]
    fn and_binds_closer_than_or_and_quoted_words_join_nothing() {
        assert_eq!(
            words("model = ridge and size != 8x8 or seed=1"),
            [vec!["model=ridge", "size!=8x8"], vec!["seed=1"]]
        );
        assert_eq!(
            words("split = by-point 50/10/40"),
            [["split=by-point 50/10/40"]]
        );
        assert_eq!(words("dataset = 'a or b'"), [["dataset=a or b"]]);
        assert_eq!(words("dataset = \"x = y\""), [["dataset=x = y"]]);
    }

    #[test]
    fn what_would_be_taken_for_something_else_is_refused_with_the_term() {
        for (text, term) in [
            ("model == ridge", "model == ridge"),
            ("model = ridge size = 8x8", "model = ridge size = 8x8"),
            ("model = ridge && seed = 1", "model = ridge && seed = 1"),
            ("(model = ridge)", "(model = ridge)"),
            ("seed > 1", "seed > 1"),
            ("seed >= 1", "seed >= 1"),
            ("not model = ridge", "not model = ridge"),
            ("model = ridge and", "model = ridge and"),
            ("model = ridge and or seed = 1", "or seed = 1"),
            ("model = ridge and seed", "seed"),
            ("model = 'ridge", "model = 'ridge"),
            ("model =", "model ="),
            ("", ""),
        ] {
            let error = alternatives(text).expect_err(text);
            assert!(
                error.starts_with(&format!("`{term}`: expected NAME = VALUE")),
                "{text}: {error}"
            );
        }
    }
}
