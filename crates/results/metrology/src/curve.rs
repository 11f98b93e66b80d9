//! Calibration curves: least squares with bands, inverse prediction, detection limits, and figures like those of ISO 376 and ISO 7500-1.
//!
//! [`CurveFit`] fits curves; [`ProvingSeries`] and [`IndicationLevel`] compute relative errors in %, which [`Standing`] compares with limits.

mod band;
mod detection;
mod fit;
mod indication;
mod inverse;
mod limits;
mod proving;
mod quality;
mod squares;
mod undefined;

pub use band::{Band, CoefficientUncertainty, CovarianceOf};
pub use detection::{Detection, DetectionRisks};
pub use fit::{CurveFit, CurveRow};
pub use indication::{Indication, IndicationFigures, IndicationLevel, IndicationSummary};
pub use inverse::InversePrediction;
pub use limits::Standing;
pub use proving::{ProvingFigures, ProvingLevel, ProvingSeries};
pub use quality::LackOfFit;
pub use undefined::CurveUndefined;
