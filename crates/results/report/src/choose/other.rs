//! Values of one quantity by other definitions. Such values are shown, but do not affect the choice.

use super::property::Property;
use crate::catalogue::{Published, Sensor};

impl Property {
    /// Values of `sensor` for the same quantity by another definition, as text; `None` if unknown.
    ///
    /// For a price, other definitions are another currency, a price of parts, and an inexact price.
    pub(super) fn other(self, sensor: &Sensor) -> Option<String> {
        let found: Vec<String> = match self {
            Property::Price(wanted) => {
                let prices = sensor.prices.iter();
                let shown = prices.map(|price| {
                    let remedy = match price.is_comparable() && price.currency != wanted {
                        true => format!("; name the bound in {}", price.currency),
                        false => String::new(),
                    };
                    format!("{} ({}{remedy})", price.shown(), price.of)
                });
                shown.collect()
            }
            // Sources order outer dimensions differently, so that none of them is the thickness.
            Property::Size | Property::Width | Property::Thickness => {
                let size = sensor.size.iter();
                let size = size.map(|of| format!("{} mm ({})", of.shown(), of.conditions));
                let results = sensor.results.iter();
                let alike = results.filter(|result| self.is_alike(result));
                size.chain(alike.map(shown)).collect()
            }
            _ => {
                let results = sensor.results.iter();
                let alike = results.filter(|result| self.is_alike(result));
                alike.map(shown).collect()
            }
        };
        (!found.is_empty()).then(|| found.join(", "))
    }

    /// True for a published number of the same quantity that [`Property::of`] does not read.
    fn is_alike(self, result: &Published) -> bool {
        let (metric, channel) = (result.metric.as_str(), result.channel.as_str());
        // The number itself, stated inexactly or without a definition.
        if self.score() == Some((metric, channel)) {
            return true;
        }
        let is_error = metric.ends_with("_error") || metric.ends_with("_rmse");
        let is_force = is_error && metric.starts_with("force") && result.unit == "N";
        let is_place = ["localisation", "localization", "position"];
        let is_place = is_place.iter().any(|start| metric.starts_with(start));
        let is_place = is_error && is_place && result.unit == "mm";
        let is_depth = ["depth", "reconstruction"];
        let is_depth = is_depth.iter().any(|start| metric.starts_with(start));
        let is_depth = is_error && is_depth && result.unit == "mm";
        match self {
            Property::Error("Fxy") => is_force && channel != "Fz",
            Property::Error("Fz") => is_force && channel != "Fxy",
            Property::Error("Pz") => is_depth || (is_place && channel == "Pz"),
            Property::Error(_) => is_place && channel != "Pz",
            Property::FrameRate => metric == "measurement_rate",
            Property::Resolution(_) => metric == "spatial_resolution",
            Property::Thickness => metric == "gel_thickness",
            Property::Size | Property::Width => (metric, channel) == ("intrinsic", "thickness"),
            Property::GelThickness => {
                metric == "gel_thickness" || (metric, channel) == ("intrinsic", "thickness")
            }
            Property::GreatestForce => metric == "force_range",
            _ => false,
        }
    }
}

/// Number with its definition: `force_error F 0.07 N (mean absolute error of the force as its authors sum it up)`.
fn shown(result: &Published) -> String {
    let unit = match result.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    format!(
        "{} {} {}{unit} ({})",
        result.metric,
        result.channel,
        result.shown(),
        result.definition
    )
}
