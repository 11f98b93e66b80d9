//! Parameters of a sensor and its rig: values with a unit and an origin, read from TOML and checked.
//!
//! Every value has the form `key = { value = 4.25, unit = "mm", origin = "geometric" }`. The origin shows the reliability of the value. For another
//! sensor, copy one of the built-in tables, change its values, and read it with [`Parameters::parse`].

mod ageing;
mod digest;
mod error;
mod gel_fault;
mod model;
mod outline;
mod quiet;
mod read;
mod section;
mod sections;

pub use digest::ParameterDigest;
pub use error::{ParameterError, ParameterErrorKind};
pub use gel_fault::GelFault;
pub use model::Model;
pub use outline::Outline;
pub use section::{Entry, Origin};
pub use sections::{
    Ageing, Camera, Dome, GelWear, Gratings, Lattice, Layer, Markers, Material, Probing, Robot,
    Search, Surface, Transducer, Variation,
};

use read::Document;
use section::Section;

/// Body of a sensor, which determines the response to a press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A flat gel on a rigid plate.
    Layer(Layer),
    /// A skin over a soft hemisphere.
    Dome(Dome),
}

/// Parameters of one kind of sensor and of its rig.
///
/// ```
/// use taceva_sim::{Model, Parameters};
/// let gelsight = Model::GelSight.parameters();
/// let mine = Parameters::parse(&Model::GelSight.table().replace("4.25", "3.5"))?;
/// assert_ne!(gelsight.digest(), mine.digest());
/// # Ok::<(), taceva_sim::ParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Name of the sensor in reports.
    pub name: String,
    /// Body of the sensor.
    pub body: Body,
    /// Surface under the indenter.
    pub surface: Surface,
    /// Relaxation and conditioning of the gel.
    pub material: Material,
    /// Probed surface and depths.
    pub probing: Probing,
    /// Variation of gels between units and places.
    pub variation: Variation,
    /// Camera of the sensor.
    pub camera: Camera,
    /// Markers in or on the gel, if any.
    pub markers: Option<Markers>,
    /// Layers of a printed lattice, if any.
    pub lattice: Option<Lattice>,
    /// Wear of the gel; `None` for a new gel.
    pub wear: Option<GelWear>,
    /// Ageing of the gel by presses; `None` for a gel that does not age.
    pub ageing: Option<Ageing>,
    /// Blur and contrast of gratings.
    pub gratings: Gratings,
    /// Robot that moves the indenter.
    pub robot: Robot,
    /// Search for first contact.
    pub search: Search,
    /// Force transducer.
    pub transducer: Transducer,
    entries: Vec<Entry>,
    digest: ParameterDigest,
}

impl Parameters {
    /// Parses the parameters in `text`.
    ///
    /// # Errors
    /// [`ParameterError`] with the line, the value found and the value expected. Causes: invalid TOML, an unknown or missing section or key, a value
    /// out of range, another unit than the declared unit, or contradictory values.
    pub fn parse(text: &str) -> Result<Parameters, ParameterError> {
        let mut document = Document::parse(text)?;
        let name = document.name()?;
        let body = match (document.optional::<Layer>()?, document.optional::<Dome>()?) {
            (Some(layer), None) => Body::Layer(layer),
            (None, Some(dome)) => Body::Dome(dome),
            (Some(_), Some(_)) => return Err(document.two_bodies()),
            (None, None) => return Err(document.missing_section(Layer::NAME)),
        };
        let surface = document.required()?;
        let material = document.required()?;
        let probing = document.required()?;
        let variation = document.required()?;
        let camera = document.required()?;
        let markers = document.optional()?;
        let lattice = document.optional()?;
        let wear: Option<GelWear> = document.optional()?;
        let ageing = document.optional()?;
        let gratings = document.required()?;
        let robot = document.required()?;
        let search = document.required()?;
        let transducer = document.required()?;
        let entries = document.finish()?;
        let parameters = Parameters {
            digest: ParameterDigest::of(&name, &entries),
            name,
            body,
            surface,
            material,
            probing,
            variation,
            camera,
            markers,
            lattice,
            wear,
            ageing,
            gratings,
            robot,
            search,
            transducer,
            entries,
        };
        parameters.check()?;
        Ok(parameters)
    }

    /// All values with section, unit, origin and line, ordered by section and key.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Digest of the parameters, 32 bytes. Equal values, units and origins give equal digests for any layout of the file.
    pub fn digest(&self) -> &ParameterDigest {
        &self.digest
    }

    /// Shift of the gel in its housing along x and y, mm.
    pub fn shift_mm(&self) -> [f64; 2] {
        self.wear.map_or([0.0; 2], |wear| wear.shift_xy_mm())
    }

    /// Rejects values that are in range but contradict each other.
    fn check(&self) -> Result<(), ParameterError> {
        let Probing {
            depth_min_mm,
            depth_max_mm,
            ..
        } = self.probing;
        if depth_min_mm >= depth_max_mm {
            return Err(self.contradiction("probing", "depth_min_mm", || {
                format!("below depth_max_mm = {depth_max_mm}")
            }));
        }
        let Body::Layer(layer) = self.body else {
            return Ok(());
        };
        let greatest = Layer::greatest_depth_mm(layer.thickness_mm, GREATEST_INDENTER_MM);
        if depth_max_mm > greatest {
            return Err(self.contradiction("probing", "depth_max_mm", || {
                format!(
                    "at most {greatest:.3}, the greatest depth of the force law for a ball of {GREATEST_INDENTER_MM} mm on a layer of {} mm",
                    layer.thickness_mm
                )
            }));
        }
        Ok(())
    }

    fn contradiction(
        &self,
        section: &'static str,
        key: &'static str,
        expected: impl FnOnce() -> String,
    ) -> ParameterError {
        let entry = self
            .entries
            .iter()
            .find(|entry| entry.section == section && entry.key == key)
            .expect("a key of a section that was read has an entry");
        ParameterError::new(
            entry.line,
            ParameterErrorKind::Range {
                key: format!("{section}.{key}"),
                value: entry.value,
                expected: expected(),
            },
        )
    }
}

/// Radius of the largest ball that presses sensors, mm.
pub(crate) const GREATEST_INDENTER_MM: f64 = 10.0;
