//! Unknown names of metrics.

use std::error::Error;
use std::fmt;

use taceva_core::shown;

use super::names;

/// A name that no metric and no group has.
///
/// ```
/// use taceva_metrics::catalogue;
/// let error = catalogue::select(["rmsee"]).unwrap_err();
/// assert_eq!(error.nearest, Some("rmse"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownMetric {
    /// Name as given.
    pub name: String,
    /// Nearest known name; `None` if no name is similar.
    pub nearest: Option<&'static str>,
}

impl fmt::Display for UnknownMetric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`: unknown metric", shown(&self.name))?;
        match self.nearest {
            Some(nearest) => write!(f, ", did you mean `{nearest}`? Known are ")?,
            None => f.write_str(", expected one of ")?,
        }
        for (position, name) in names().enumerate() {
            let separator = if position == 0 { "" } else { ", " };
            write!(f, "{separator}{name}")?;
        }
        Ok(())
    }
}

impl Error for UnknownMetric {}
