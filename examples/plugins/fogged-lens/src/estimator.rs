//! A fogged lens: pictures lose contrast. The model of a fault is loaded from severity and size, and predicts the pixel values of a picture with the
//! fault.

use taceva_core::{
    Channels, DriverKey, ErrorKind, FeatureShape, Features, ModelError, Regressor, Saved,
    SavedRegressor,
};
use taceva_plugin::{EstimatorFactory, FitRequest};

static KEY: DriverKey = DriverKey::fixed("org.example.fogged-lens/fog");

/// First line of the bytes of a fault.
const HEAD: &str = "taceva.fault/1";
/// Fraction of the contrast that each severity step removes.
const LOST: f64 = 0.15;

/// Factory of the fault.
pub(crate) fn factory() -> Box<dyn EstimatorFactory> {
    Box::new(Fog)
}

struct Fog;

impl EstimatorFactory for Fog {
    fn key(&self) -> &DriverKey {
        &KEY
    }

    fn title(&self) -> &str {
        "fault: a fogged lens"
    }

    fn fit(&self, _: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let why = "a fault is not fitted; name it by [[fault]] in a scene";
        Err(ModelError::new(ErrorKind::Unsupported, why))
    }

    /// `saved.bytes` has a line for each of severity, seed, sample, width, height, full scale and number of values per pixel.
    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let severity = severity(saved.bytes).ok_or_else(|| {
            ModelError::new(ErrorKind::Protocol, "expected the lines of a fault with `severity` from 1 to 5")
        })?;
        Ok(Box::new(Fogged {
            severity,
            bytes: saved.bytes.to_vec(),
            channels: saved.channels.clone(),
            shape: saved.shape,
        }))
    }
}

/// Severity in the bytes of a fault.
fn severity(bytes: &[u8]) -> Option<u8> {
    let text = std::str::from_utf8(bytes).ok()?;
    let mut lines = text.lines();
    let lines = lines.next().filter(|head| *head == HEAD).map(|_| lines)?;
    let mut stated = lines.filter_map(|line| line.strip_prefix("severity="));
    let severity: u8 = stated.next()?.parse().ok()?;
    (1..=5).contains(&severity).then_some(severity)
}

/// A fogged lens of one severity.
struct Fogged {
    severity: u8,
    bytes: Vec<u8>,
    channels: Channels,
    shape: FeatureShape,
}

impl Regressor for Fogged {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    /// A sample is a pixel, row by row from the top; a call has all pixels of one picture.
    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        let numbers = features.values();
        if features.shape() != self.shape || into.len() != numbers.len() {
            return Err(ModelError::new(ErrorKind::InvalidArgument, "a picture of another depth"));
        }
        let sum: f64 = numbers.iter().map(|number| f64::from(*number)).sum();
        let mean = sum / numbers.len().max(1) as f64;
        let left = 1.0 - LOST * f64::from(self.severity);
        for (to, from) in into.iter_mut().zip(numbers) {
            *to = mean + left * (f64::from(*from) - mean);
        }
        Ok(())
    }
}

impl SavedRegressor for Fogged {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        Ok(self.bytes.clone())
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_manifest_says_what_the_estimator_says_of_itself() {
        let table = taceva_plugin::estimator_table(&*super::factory());
        assert!(include_str!("../plugin.toml").contains(&table), "[[provides]]\n{table}");
    }

    #[test]
    fn other_bytes_are_no_fault() {
        assert_eq!(super::severity(b"taceva.fault/1\nseverity=3\nseed=7\n"), Some(3));
        for other in ["", "taceva.fault/2\nseverity=3\n", "taceva.fault/1\nseverity=6\n"] {
            assert_eq!(super::severity(other.as_bytes()), None, "{other}");
        }
    }
}
