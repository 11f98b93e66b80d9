//! Tuple parameters of functions. Each should be a type with named fields.

use super::sources::Source;

/// Tuple parameters of functions in product code, as `path: fn name: (A, B)`.
pub fn tuple_parameters(sources: &[Source]) -> Vec<String> {
    let mut found = Vec::new();
    for source in sources.iter().filter(|source| source.is_product()) {
        for (name, types) in parameters(&source.product_code) {
            let tuples = types.into_iter().filter(|kind| is_tuple(kind));
            found.extend(tuples.map(|kind| format!("{}: fn {name}: {kind}", source.path)));
        }
    }
    found
}

/// Functions declared in `code`, with the types of their parameters.
fn parameters(code: &str) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("fn ") {
        let starts_a_word =
            code[..at].ends_with(|letter: char| letter.is_alphanumeric() || letter == '_');
        let rest = &code[at + 3..];
        let name: String = rest
            .chars()
            .take_while(|letter| letter.is_alphanumeric() || *letter == '_')
            .collect();
        let Some(open) = rest
            .find('(')
            .filter(|_| !starts_a_word && !name.is_empty())
        else {
            continue;
        };
        let inside = balanced(&rest[open + 1..]);
        let types = split(inside).into_iter().filter_map(|parameter| {
            let (_, kind) = parameter.split_once(':')?;
            Some(kind.split_whitespace().collect::<Vec<_>>().join(" "))
        });
        found.push((name, types.collect()));
    }
    found
}

/// Part of `text` before the bracket that closes an earlier opening bracket.
fn balanced(text: &str) -> &str {
    let mut depth = 1_usize;
    for (at, letter) in text.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &text[..at];
        }
    }
    text
}

/// Parts between commas outside brackets.
fn split(text: &str) -> Vec<String> {
    let (mut parts, mut depth) = (vec![String::new()], 0_isize);
    let mut before = ' ';
    for letter in text.chars() {
        match letter {
            '(' | '[' | '<' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            '>' if before != '-' && before != '=' => depth -= 1,
            _ => {}
        }
        before = letter;
        match (letter, parts.last_mut()) {
            (',', _) if depth == 0 => parts.push(String::new()),
            (letter, Some(last)) => last.push(letter),
            (_, None) => {}
        }
    }
    parts
}

/// True if the type, by value or by reference, is a tuple of two or more elements.
fn is_tuple(kind: &str) -> bool {
    let kind = kind
        .trim_start_matches(['&', ' '])
        .trim_start_matches("mut ");
    let Some(inside) = kind
        .strip_prefix('(')
        .and_then(|inside| inside.strip_suffix(')'))
    else {
        return false;
    };
    split(inside)
        .iter()
        .filter(|part| !part.trim().is_empty())
        .count()
        > 1
}

#[cfg(test)]
mod tests {
    use super::{is_tuple, parameters};

    #[test]
    fn tuples_are_found_behind_references_and_patterns() {
        let code =
            "fn a(b: (u8, u8), &(c, d): &(A, B), e: Vec<(A, B)>, f: impl Fn(A, B) -> (A, B)) {}";
        let found = parameters(code);
        let tuples: Vec<&String> = found[0].1.iter().filter(|kind| is_tuple(kind)).collect();
        assert_eq!(tuples, ["(u8, u8)", "&(A, B)"]);
    }
}
