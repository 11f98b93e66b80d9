//! Paths to values inside cells: `pose.x`, `ft[2]`, `ft[2,0]`.

/// Finds the longest of `names` with which `text` begins. Returns its index and the rest of `text`. A name may contain dots and brackets.
///
/// The rest begins with a bracket, or follows the dot before a member.
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

/// Numbers in the bracket at the start of `text` (`[2]` or `[2,0]`), and the text after the bracket, without a dot before a member.
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
