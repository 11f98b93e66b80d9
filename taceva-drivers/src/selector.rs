//! Selector of a driver with arguments: `sim/gelsight:seed=3;unit=2`.

use std::fmt;
use std::str::FromStr;

/// Driver and arguments, as the user writes them. The driver may not exist.
///
/// ```
/// use taceva_drivers::Selector;
/// let selector: Selector = "sim/gelsight:seed=3;unit=2".parse()?;
/// assert_eq!(selector.driver(), "sim/gelsight");
/// assert_eq!(selector.arguments(), "seed=3;unit=2");
/// # Ok::<(), taceva_drivers::SelectorError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selector {
    driver: String,
    arguments: String,
}

impl Selector {
    /// Key of the driver.
    pub fn driver(&self) -> &str {
        &self.driver
    }

    /// Arguments, as [`Args::parse`](taceva_core::Args::parse) reads them; empty if there are none.
    pub fn arguments(&self) -> &str {
        &self.arguments
    }

    /// Serial number that selects one of several connected devices; `None` without the argument `serial`.
    ///
    /// ```
    /// use taceva_drivers::Selector;
    /// let selector: Selector = "hid/scale:usb=0922:8003; serial=B2".parse()?;
    /// assert_eq!(selector.serial(), Some("B2"));
    /// # Ok::<(), taceva_drivers::SelectorError>(())
    /// ```
    pub fn serial(&self) -> Option<&str> {
        self.argument("serial")
    }

    fn argument(&self, key: &str) -> Option<&str> {
        let arguments = self.arguments.split(';').map(str::trim);
        let mut pairs = arguments.filter_map(|argument| argument.split_once('='));
        let found = pairs.find(|(name, _)| name.trim() == key);
        found.map(|(_, value)| value.trim())
    }

    /// Name of the simulated bench that the device belongs to, as used by [`Rig::bench`](taceva_core::Rig::bench). `None` if the driver's key has
    /// no `/`.
    ///
    /// ```
    /// use taceva_drivers::Selector;
    /// let selector: Selector = "sim/gelsight:seed=3;rig=left".parse()?;
    /// assert_eq!(selector.bench().as_deref(), Some("sim left"));
    /// # Ok::<(), taceva_drivers::SelectorError>(())
    /// ```
    pub fn bench(&self) -> Option<String> {
        let (makers, _) = self.driver.rsplit_once('/')?;
        let name = self.argument("rig");
        Some(format!("{makers} {}", name.unwrap_or("bench")))
    }
}

impl FromStr for Selector {
    type Err = SelectorError;

    fn from_str(text: &str) -> Result<Selector, SelectorError> {
        let (driver, arguments) = text.split_once(':').unwrap_or((text, ""));
        let driver = driver.trim();
        if driver.is_empty() || driver.contains(['=', ';']) {
            return Err(SelectorError {
                text: text.to_owned(),
            });
        }
        Ok(Selector {
            driver: driver.to_owned(),
            arguments: arguments.trim().to_owned(),
        })
    }
}

impl fmt::Display for Selector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.driver)?;
        match self.arguments.as_str() {
            "" => Ok(()),
            arguments => write!(f, ":{arguments}"),
        }
    }
}

/// A selector that names no driver.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} names no driver, expected `driver` or `driver:key=value;key=value`, such as `sim/gelsight:seed=3`"
)]
pub struct SelectorError {
    text: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_behind_the_first_colon_is_arguments() {
        let selector: Selector = r"sensor/replay: folder=C:\frames ".parse().expect("good");
        assert_eq!(selector.arguments(), r"folder=C:\frames");
        assert_eq!(selector.to_string(), r"sensor/replay:folder=C:\frames");
        let bare: Selector = "sim/robot".parse().expect("good");
        assert_eq!((bare.driver(), bare.arguments()), ("sim/robot", ""));
        assert_eq!(bare.to_string(), "sim/robot");
    }

    #[test]
    fn text_without_a_driver_is_refused() {
        for text in ["", ":", " :seed=3", "seed=3", "a;b"] {
            assert!(text.parse::<Selector>().is_err(), "{text}");
        }
    }
}
