//! Splits names of columns into words.

/// Words of a name, in lower case. Splits `wrench.force.x`, `Fx_mN` and `ForceX`.
pub(crate) fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        let is_new = letter.is_ascii_uppercase() && before.is_ascii_lowercase();
        if is_new || !letter.is_ascii_alphabetic() {
            words.push(String::new());
        }
        if letter.is_ascii_alphabetic()
            && let Some(last) = words.last_mut()
        {
            last.push(letter.to_ascii_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}
