//! Lists without repetition.

/// Different items of `all`, in the order of their first appearance.
///
/// ```
/// assert_eq!(taceva_core::distinct(["Fz", "Pz", "Fz"]), ["Fz", "Pz"]);
/// ```
pub fn distinct<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for one in all {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}
