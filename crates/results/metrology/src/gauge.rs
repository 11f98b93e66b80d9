//! Gauge studies: variance components of a measuring system.
//!
//! A *part* is a contact condition, an *operator* is the varied factor (unit, gel, day, person, laboratory), a *trial* is a repeat. Sums are exact,
//! so no result depends on the order of the readings.
//!
//! ```
//! use taceva_metrology::gauge::{GaugeSettings, GaugeStudy, ComponentName};
//! let mut study = GaugeStudy::default();
//! for (part, depth) in [("p1", 1.0), ("p2", 2.0), ("p3", 3.0)] {
//!     for (unit, shift) in [("A", 0.0), ("B", 0.1)] {
//!         study.add(part, unit, "1", depth + shift)?;
//!         study.add(part, unit, "2", depth + shift + 0.02)?;
//!     }
//! }
//! let mut settings = GaugeSettings::default();
//! settings.unit = "mm".into();
//! let report = study.analyse(&settings)?;
//! assert_eq!((report.parts, report.operators, report.trials), (3, 2, 2));
//! let gauge = report.component(ComponentName::Gauge).ok_or("always there")?;
//! assert!(gauge.percent_study.is_some_and(|percent| percent < 10.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Reference
//! Automotive Industry Action Group, Measurement Systems Analysis, 4th edition (2010); Burdick, Borror and Montgomery, Design and Analysis
//! of Gauge R&R Studies (2005).

mod anova;
mod assembly;
mod cells;
mod error;
mod intervals;
mod range;
mod reading;
mod report;
mod settings;
mod study;
mod table;
mod text;

pub use error::GaugeError;
pub use range::{RangeConstants, RangeEstimate};
pub use report::{
    Band, Component, ComponentName, Flag, GaugeReport, IntervalMethod, Ndc, NdcReason, SCHEMA,
};
pub use settings::{Design, GaugeSettings, Method};
pub use study::GaugeStudy;
pub use table::{Source, TableRow};
pub use taceva_metrics::OneWay;
