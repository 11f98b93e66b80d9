//! Variance components of the residuals of a result.

use taceva_core::shown;
use taceva_metrology::budget::{Components, Residuals};
use taceva_results::Samples;

/// Variance components of the residuals of `channel` in the protocol phase `part`, grouped by `column`.
///
/// ```
/// use taceva_results::Samples;
/// let table = "sample,point_id,Fz,Fz_predicted\n1,a,0.51,0.50\n2,a,0.53,0.50\n3,b,0.46,0.50\n4,b,0.48,0.50\n";
/// let samples = Samples::read(table)?;
/// let found = taceva_report::residual_components(&samples, "Fz", "calibration", "point_id")?;
/// assert!(found.between.u > found.within.u);
/// let absent = taceva_report::residual_components(&samples, "Fz", "calibration", "scene");
/// assert_eq!(absent.unwrap_err(), "the samples have no column `scene`");
/// let bare = Samples::read("sample,Fz,Fz_predicted\n1,0.51,0.50\n")?;
/// let absent = taceva_report::residual_components(&bare, "Fz", "calibration", "point_id");
/// assert!(absent.unwrap_err().contains("under [ids] of the map"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A message about a missing column or prediction, or about too few rows.
pub fn residual_components(
    samples: &Samples,
    channel: &str,
    part: &str,
    column: &str,
) -> Result<Components, String> {
    let pairs = samples.channel(channel);
    let Some(pairs) = pairs.filter(|of| of.is_predicted()) else {
        return Err(format!(
            "the samples have no prediction of `{}`",
            shown(channel)
        ));
    };
    if !samples.has(column) {
        let remedy = match column {
            "point_id" => ": name the contact points by `point_id` under [ids] of the map",
            _ => "",
        };
        return Err(format!("the samples have no column `{column}`{remedy}"));
    }
    let mut residuals = Residuals::default();
    for row in samples.of_protocol(part) {
        let word = samples.word(column, row);
        if let (Some([truth, prediction]), Some(word)) = (pairs.pair(row), word) {
            residuals.add(word, truth, prediction);
        }
    }
    residuals.components().map_err(|error| error.to_string())
}
