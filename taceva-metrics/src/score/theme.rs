//! Sections of reports.

/// Section of a report, with the scores of one subject, such as accuracy.
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
    /// Finest recognised detail and least detected force.
    Detail,
    /// Sensitivity of the gel surface: indentation per newton, and its uniformity over the surface.
    Surface,
    /// Changes of results with place, light, time, repetition and unit of the sensor.
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

    /// Name of the section in the anchors of pages.
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
