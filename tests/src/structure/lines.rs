//! Numbers of lines of code in each package.

use std::collections::BTreeMap;

use super::sources::Source;

/// Numbers of lines of one package.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// Number of lines of product code that are neither blank nor comment, without tests, benches and examples.
    pub product: usize,
    /// Number of all lines in the `.rs` files of the package.
    pub all: usize,
}

/// Numbers of lines of each package.
pub fn lines(sources: &[Source]) -> BTreeMap<&str, Lines> {
    let mut found: BTreeMap<&str, Lines> = BTreeMap::new();
    for source in sources {
        let of_package = found.entry(&source.package).or_default();
        let all = source.text.lines().count();
        of_package.all += all;
        of_package.product += match source.is_product() {
            true => product_lines(&source.text),
            false => 0,
        };
    }
    found
}

/// Number of lines of `text` that are neither blank nor comment, without `#[cfg(test)]` items. Lines within a multi-line string count.
fn product_lines(text: &str) -> usize {
    let mut count = 0;
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let line = line.trim();
        if line.starts_with("#[cfg(test)]") {
            skip_item(&mut lines);
        } else if !line.is_empty() && !line.starts_with("//") {
            count += 1;
        }
    }
    count
}

/// Skips the item that begins with the next line.
fn skip_item(lines: &mut std::str::Lines<'_>) {
    let (mut depth, mut is_open) = (0_isize, false);
    for line in lines {
        let code = crate::source::without_text(line);
        let count = |letter| isize::try_from(code.matches(letter).count()).unwrap_or(isize::MAX);
        depth += count('{') - count('}');
        is_open |= code.contains('{');
        let is_statement = !is_open && code.trim_end().ends_with(';');
        if is_statement || (is_open && depth <= 0) {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::product_lines;

    #[test]
    fn comments_blank_lines_and_tests_do_not_count() {
        let text = "//! A file.\n\nuse a::b;\n#[cfg(test)]\nuse c::{\n    d,\n};\n/// It.\nfn e() {}\n\n#[cfg(test)]\nmod tests {\n    fn f() {}\n}\n";
        assert_eq!(product_lines(text), 2);
    }
}
