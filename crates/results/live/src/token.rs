//! Secret token that requests must contain.

use std::fmt;

use crate::error::PageError;

/// Token of 128 random bits, in hexadecimal.
#[derive(Clone)]
pub(crate) struct Token(String);

impl Token {
    /// Creates a token from random numbers of the operating system.
    pub(crate) fn random() -> Result<Token, PageError> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|error| PageError::Random(error.to_string()))?;
        Ok(Token(
            bytes.iter().map(|byte| format!("{byte:02x}")).collect(),
        ))
    }

    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// True if `given` equals the token. Compares in constant time, so that the response time does not reveal the token.
    pub(crate) fn is(&self, given: &[u8]) -> bool {
        let own = self.0.as_bytes();
        let pairs = own.iter().zip(given.iter().chain(std::iter::repeat(&0)));
        let differing = pairs.fold(0, |differing, (own, given)| differing | (own ^ given));
        differing == 0 && given.len() == own.len()
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(…)")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_tokens_differ_and_only_the_whole_is_accepted() {
        let [one, other] = [(); 2].map(|()| Token::random().expect("random numbers"));
        assert_eq!(one.text().len(), 32);
        assert!(one.is(one.text().as_bytes()) && !one.is(other.text().as_bytes()));
        let longer = format!("{}0", one.text());
        for wrong in ["", &one.text()[..31], &longer] {
            assert!(!one.is(wrong.as_bytes()), "{wrong}");
        }
        assert_eq!(format!("{one:?}"), "Token(…)");
    }
}
