//! Places inside cells as they are written: `pose.x`, `ft[2]`, `ft[2,0]`.

/// Which of `names` `text` begins with, and what follows it: the longest, so that a name may have dots and brackets itself.
///
/// What follows begins with a bracket, or has lost the dot that led to it.
pub(crate) fn longest<'a, 'n>(
    text: &'a str,
    names: impl Iterator<Item = &'n str>,
) -> Option<(usize, &'a str)> {
    let mut best: Option<(usize, usize, &str)> = None;
    for (at, name) in names.enumerate() {
        let Some(rest) = text.strip_prefix(name) else {
            continue;
        };
        let rest = match rest.strip_prefix('.') {
            Some("") => continue,
            Some(member) => member,
            None if rest.is_empty() || rest.starts_with('[') => rest,
            None => continue,
        };
        if best.is_none_or(|(_, length, _)| name.len() > length) {
            best = Some((at, name.len(), rest));
        }
    }
    best.map(|(at, _, rest)| (at, rest))
}

/// The numbers in the bracket that `text` begins with, `[2]` or `[2,0]`, and what follows it, without the dot that leads to a member.
pub(crate) fn indices(text: &str) -> Option<(Vec<usize>, &str)> {
    let (inside, after) = text.strip_prefix('[')?.split_once(']')?;
    let is_index = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let numbers = inside
        .split(',')
        .map(|number| is_index(number).then(|| number.parse().ok())?)
        .collect::<Option<Vec<usize>>>()?;
    let after = match after.strip_prefix('.') {
        Some("") => return None,
        Some(member) => member,
        None if after.is_empty() || after.starts_with('[') => after,
        None => return None,
    };
    Some((numbers, after))
}
