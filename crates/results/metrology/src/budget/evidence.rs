//! Measured figures that sources use by `from`, and the certificate of the reference.

use std::collections::BTreeMap;

use super::certificate::Certificate;
use super::freedom::Freedom;

/// Measured uncertainty that a source of a budget can use by name, in the unit of the measurand.
///
/// ```
/// use taceva_metrology::budget::{Figure, Freedom};
/// let within = Figure::new(0.024, Freedom::Finite(60.0)).of_rows(120, 60);
/// assert_eq!((within.u, within.n), (0.024, Some(120)));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Figure {
    /// Estimate: a correction added to the reading, usually 0. For the figure `drift`, the slope per hour.
    pub value: f64,
    /// Standard uncertainty.
    pub u: f64,
    /// Degrees of freedom of `u`.
    pub freedom: Freedom,
    /// Number of rows from which the figure was computed; `None` if unknown.
    pub n: Option<u64>,
    /// Number of clusters among these rows, such as contact points; `None` if unknown.
    pub clusters: Option<u64>,
    /// Least and greatest true value of the channel in these rows; `None` if unknown.
    pub labels: Option<[f64; 2]>,
    /// Digest of the figure's source file; `None` if unknown.
    pub digest: Option<String>,
    /// Caveat that every output repeats; `None` for no caveat.
    pub note: Option<String>,
}

impl Figure {
    /// A figure with the estimate 0.
    pub fn new(u: f64, freedom: Freedom) -> Figure {
        Figure {
            value: 0.0,
            u,
            freedom,
            n: None,
            clusters: None,
            labels: None,
            digest: None,
            note: None,
        }
    }

    /// Figure of a drift of idle readings, in units of the measurand per hour.
    pub fn of_drift(slope_per_hour: f64) -> Figure {
        Figure {
            value: slope_per_hour,
            ..Figure::new(0.0, Freedom::Infinite)
        }
    }

    /// The same figure with the estimate `value`.
    #[must_use]
    pub fn of_estimate(self, value: f64) -> Figure {
        Figure { value, ..self }
    }

    /// The same figure with its numbers of rows and clusters.
    #[must_use]
    pub fn of_rows(self, n: u64, clusters: u64) -> Figure {
        Figure {
            n: Some(n),
            clusters: Some(clusters),
            ..self
        }
    }

    /// The same figure with the digest of its file.
    #[must_use]
    pub fn of_digest(self, digest: &str) -> Figure {
        Figure {
            digest: Some(digest.to_owned()),
            ..self
        }
    }
}

/// Measured figures and the certificate for a budget.
///
/// ```
/// use taceva_metrology::budget::{Evidence, Figure, Freedom};
/// let evidence = Evidence::default().with("repeatability", Figure::new(0.015, Freedom::Finite(476.0)));
/// assert!(evidence.figure("repeatability").is_some());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    figures: BTreeMap<String, Figure>,
    certificate: Option<Certificate>,
}

impl Evidence {
    /// The same evidence with the figure that sources use by `from = "name"`.
    #[must_use]
    pub fn with(mut self, name: &str, figure: Figure) -> Evidence {
        self.figures.insert(name.to_owned(), figure);
        self
    }

    /// The same evidence with the certificate of the reference, which sources use by `from = "certificate"`.
    #[must_use]
    pub fn with_certificate(self, certificate: Certificate) -> Evidence {
        Evidence {
            certificate: Some(certificate),
            ..self
        }
    }

    /// The figure called `name`; `None` for an unknown name.
    pub fn figure(&self, name: &str) -> Option<&Figure> {
        self.figures.get(name)
    }

    /// Names of all figures, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.figures.keys().map(String::as_str)
    }

    /// Certificate of the reference; `None` without a certificate.
    pub fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }
}
