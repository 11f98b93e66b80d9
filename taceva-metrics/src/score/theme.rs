//! Sections of reports.

/// Section of a report, with scores of one subject.
///
/// ```
/// use taceva_metrics::{Theme, catalogue};
/// let mae = catalogue::find("mae").ok_or("a metric")?;
/// assert_eq!((mae.theme, mae.theme.title()), (Theme::Accuracy, "Accuracy"));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Theme {
    /// Errors of predictions.
    Accuracy,
    /// Finest detail and least force.
    Detail,
    /// Compliance of the gel.
    Surface,
    /// Changes with place, light, time, repetition and unit.
    Robustness,
    /// Camera and field of view.
    Camera,
}

impl Theme {
    /// Every theme, in the order of reports.
    pub const ALL: [Theme; 5] = [
        Theme::Accuracy,
        Theme::Detail,
        Theme::Surface,
        Theme::Robustness,
        Theme::Camera,
    ];

    /// Name in page anchors.
    pub const fn id(self) -> &'static str {
        match self {
            Theme::Accuracy => "accuracy",
            Theme::Detail => "detail",
            Theme::Surface => "surface",
            Theme::Robustness => "robustness",
            Theme::Camera => "camera",
        }
    }

    /// Heading of the section.
    pub const fn title(self) -> &'static str {
        match self {
            Theme::Accuracy => "Accuracy",
            Theme::Detail => "Finest detail and least force",
            Theme::Surface => "Sensitivity",
            Theme::Robustness => "Robustness",
            Theme::Camera => "Camera and field of view",
        }
    }
}
