//! Finds taxels in columns with an axis and a number in brackets: `X[0]`, `Y[0]`, `Z[0]`, `X[1]`, and so on.

use std::collections::BTreeMap;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Number of axes of each taxel.
pub(super) const COUNT: usize = AXES.len();

/// Text before the axis, and the column number within the taxels: `1-2-NxN-` and 13 for `1-2-NxN-Y[4]`, that is 3 · 4 + 1.
fn place(name: &str) -> Option<(&str, usize)> {
    let (before, number) = name.strip_suffix(']')?.rsplit_once('[')?;
    let (stem, axis) = before.split_at_checked(before.len().checked_sub(1)?)?;
    let axis = AXES
        .iter()
        .position(|known| known.eq_ignore_ascii_case(axis))?;
    let number: usize = number.parse().ok()?;
    Some((stem, number.checked_mul(COUNT)? + axis))
}

/// Complete series among `names`, each as the positions of its columns in order. A complete series has every axis for every taxel number.
pub(super) fn series<'n>(names: impl Iterator<Item = &'n str>) -> Vec<Vec<usize>> {
    let mut found: BTreeMap<&str, Vec<(usize, usize)>> = BTreeMap::new();
    for (position, name) in names.enumerate() {
        if let Some((stem, place)) = place(name) {
            found.entry(stem).or_default().push((place, position));
        }
    }
    let is_complete = |places: &Vec<(usize, usize)>| {
        let mut numbered = places.iter().enumerate();
        places.len().is_multiple_of(COUNT) && numbered.all(|(at, (place, _))| at == *place)
    };
    let complete = found.into_values().filter(is_complete);
    complete
        .map(|places| places.into_iter().map(|(_, position)| position).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_counted_by_number_and_axis() {
        assert_eq!(place("1-2-NxN-Y[4]"), Some(("1-2-NxN-", 13)));
        assert_eq!(place("x[0]"), Some(("", 0)));
        for other in ["taxel[3]", "x", "[0]", "x[-1]", "é[0]", "x[0] N"] {
            assert_eq!(place(other), None, "{other}");
        }
    }
}
