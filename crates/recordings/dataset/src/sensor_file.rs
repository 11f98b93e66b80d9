//! Facts about a sensor in a separate file, for tables of numbers, which contain no such facts.

use std::path::Path;

use serde::Deserialize;

use crate::error::DatasetError;
use crate::header::{Footprint, Known};
use crate::toml_file::{parse_toml, read_toml_text, toml_error};

/// Content of a sensor file. Every key is optional; `None` for a missing key.
///
/// ```toml
/// model = "DIGIT"
/// opaque = true
/// depth_max_mm = 1.0
///
/// [footprint]
/// shape = "rect"
/// half_x_mm = 8.0
/// half_y_mm = 10.0
/// ```
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sensor.toml");
/// std::fs::write(&path, "model = \"DIGIT\"\nopaque = true\n")?;
/// let sensor = taceva_dataset::SensorFile::read(&path)?;
/// assert_eq!((sensor.model.as_deref(), sensor.opaque), (Some("DIGIT"), Some(true)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct SensorFile {
    /// Name of the sensor model.
    pub model: Option<String>,
    /// Serial number of the unit.
    pub serial: Option<String>,
    /// Id of the gel.
    pub gel: Option<String>,
    /// True if ambient light cannot reach the camera.
    pub opaque: Option<bool>,
    /// Light scene with which the other scenes are compared.
    pub reference_scene: Option<String>,
    /// Sensing area of the sensor.
    pub footprint: Option<taceva_core::Footprint>,
    /// Width and height of the sensor's pictures, pixels.
    pub frame_size: Option<[u32; 2]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    model: Option<String>,
    serial: Option<String>,
    gel: Option<String>,
    opaque: Option<Known<bool>>,
    reference_scene: Option<String>,
    depth_max_mm: Option<f64>,
    frame_size: Option<[u32; 2]>,
    footprint: Option<Footprint>,
}

impl SensorFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`DatasetError::Text`] with the line for invalid TOML, an unknown key, or an impossible length; [`DatasetError::Path`],
    /// [`DatasetError::Io`].
    pub fn read(path: &Path) -> Result<SensorFile, DatasetError> {
        let written: Written = parse_toml(path, &read_toml_text(path)?)?;
        let wrong = |problem: &str| toml_error(path, None, problem);
        let footprint = match (written.footprint, written.depth_max_mm) {
            (Some(footprint), depth) => {
                if depth.is_some() && footprint.depth_max_mm.is_some() {
                    return Err(wrong(
                        "`depth_max_mm` is both inside and outside [footprint]: remove one",
                    ));
                }
                let whole = Footprint {
                    depth_max_mm: footprint.depth_max_mm.or(depth),
                    ..footprint
                };
                Some(whole.to_core().map_err(|problem| wrong(&problem))?)
            }
            (None, Some(_)) => return Err(wrong("`depth_max_mm` needs a table [footprint]")),
            (None, None) => None,
        };
        if written.frame_size.is_some_and(|size| size.contains(&0)) {
            return Err(wrong("`frame_size` has no pixel, expected [width, height]"));
        }
        Ok(SensorFile {
            model: written.model,
            serial: written.serial,
            gel: written.gel,
            opaque: written.opaque.and_then(|fact| match fact {
                Known::Is(opaque) => Some(opaque),
                Known::Unknown => None,
            }),
            reference_scene: written.reference_scene,
            footprint,
            frame_size: written.frame_size,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::Nanometre;

    fn read(text: &str) -> Result<SensorFile, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("sensor.toml");
        std::fs::write(&path, text).expect("written");
        SensorFile::read(&path).map_err(|error| error.to_string())
    }

    #[test]
    fn the_greatest_depth_may_stand_beside_the_outline_or_in_it() {
        let disc = "[footprint]\nshape = \"disc\"\nradius_mm = 17.0\n";
        for text in [
            format!("opaque = false\ndepth_max_mm = 3.5\n{disc}"),
            format!("opaque = false\n{disc}depth_max_mm = 3.5\n"),
        ] {
            let file = read(&text).expect("reads");
            assert_eq!(file.opaque, Some(false));
            let depth = file.footprint.and_then(|footprint| footprint.depth_max());
            assert_eq!(depth, Some(Nanometre(3_500_000)));
        }
        let twice = read(&format!("depth_max_mm = 1.0\n{disc}depth_max_mm = 3.5\n"));
        assert!(twice.expect_err("twice").contains("remove one"));
    }

    #[test]
    fn what_no_sensor_has_is_refused() {
        for (text, expected) in [
            ("oqaque = true", "did you mean `opaque`?"),
            ("[footprint]\nshape = \"disc\"", "needs `radius_mm`"),
            (
                "[footprint]\nshape = \"disc\"\nradius_mm = -1.0",
                "-1 mm is not a length",
            ),
            (
                "[footprint]\nshape = \"disc\"\nradius_mm = 1e9",
                "`radius_mm` is 1000000000",
            ),
            ("[footprint]\nshape = \"oval\"", "oval"),
            ("depth_max_mm = 1.0", "needs a table [footprint]"),
            ("frame_size = [640, 0]", "has no pixel"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.contains(expected), "{error}");
        }
        assert_eq!(read(""), Ok(SensorFile::default()));
    }
}
