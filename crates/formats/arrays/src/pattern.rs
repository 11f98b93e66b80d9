//! Patterns of group names. `*` matches any characters except `/`.

/// True if `name` matches `pattern`. A leading slash is ignored.
pub(crate) fn matches(pattern: &str, name: &str) -> bool {
    let pattern = pattern.trim_matches('/').split('/');
    let mut parts = name.trim_matches('/').split('/');
    let is_alike = pattern
        .into_iter()
        .all(|wanted| parts.next().is_some_and(|part| part_matches(wanted, part)));
    is_alike && parts.next().is_none()
}

/// True if `part`, a name between slashes, matches `pattern`. The texts between the stars of the pattern are searched from left to right.
fn part_matches(pattern: &str, part: &str) -> bool {
    if part.is_empty() {
        return pattern.is_empty();
    }
    let mut pieces = pattern.split('*');
    let first = pieces.next().unwrap_or("");
    let Some(mut rest) = part.strip_prefix(first) else {
        return false;
    };
    let Some(last) = pieces.next_back() else {
        return rest.is_empty();
    };
    for piece in pieces {
        let Some(at) = rest.find(piece) else {
            return false;
        };
        rest = &rest[at + piece.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stay_between_slashes() {
        for (pattern, name, expected) in [
            ("/*", "/press_1", true),
            ("/*", "/press_1/camera", false),
            ("/press_*", "/press_12", true),
            ("/press_*", "/pose", false),
            ("/data/demo_*/obs", "/data/demo_3/obs", true),
            ("/a*b*c", "/a-b-b-c", true),
            ("/a*b*c", "/a-c", false),
            ("/ab*ba", "/aba", false),
            ("data", "/data", true),
            ("/", "/", true),
            ("/*", "/", false),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} {name}");
        }
    }
}
