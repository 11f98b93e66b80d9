//! What a sensor and its rig are: numbers with a unit and an origin, read from TOML and checked.
//!
//! Every number is written `key = { value = 4.25, unit = "mm", origin = "geometric" }`; the origin says how far to trust it. A sensor
//! of one's own is a copy of one of the compiled-in tables with other numbers, read by [`Parameters::parse`].

mod digest;
mod error;
mod model;
mod outline;
mod quiet;
mod read;
mod section;
mod sections;

pub use digest::ParameterDigest;
pub use error::{ParameterError, ParameterErrorKind};
pub use model::Model;
pub use outline::Outline;
pub use section::{Entry, Origin};
pub use sections::{
    Camera, Dome, Gratings, Lattice, Layer, Markers, Material, Probing, Robot, Search, Surface,
    Transducer, Variation,
};

use read::Document;
use section::Section;

/// The body of a sensor: what answers a press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A flat gel on a rigid plate.
    Layer(Layer),
    /// A skin over a soft hemisphere.
    Dome(Dome),
}

/// Everything the bench knows of one kind of sensor and of the rig that tests it.
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
    /// The name of the sensor, as reports write it.
    pub name: String,
    /// What answers a press.
    pub body: Body,
    /// What the indenter touches.
    pub surface: Surface,
    /// How the gel forgets.
    pub material: Material,
    /// Where and how deep the sensor may be pressed.
    pub probing: Probing,
    /// How units and places differ.
    pub variation: Variation,
    /// What the camera of the sensor gives.
    pub camera: Camera,
    /// What is printed in or on the gel, if anything is.
    pub markers: Option<Markers>,
    /// The layers of a printed lattice, if there is one.
    pub lattice: Option<Lattice>,
    /// How gratings are seen.
    pub gratings: Gratings,
    /// What moves the indenter.
    pub robot: Robot,
    /// How contact is found.
    pub search: Search,
    /// What measures the force.
    pub transducer: Transducer,
    entries: Vec<Entry>,
    digest: ParameterDigest,
}

impl Parameters {
    /// The parameters written in `text`.
    ///
    /// # Errors
    /// [`ParameterError`]: not TOML, an unknown or missing section or key, a value outside its range, another unit than the declared
    /// one, or numbers that contradict each other; with the line, what was found and what was expected.
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
            gratings,
            robot,
            search,
            transducer,
            entries,
        };
        parameters.check()?;
        Ok(parameters)
    }

    /// Every number with its section, unit, origin and line, in the order of section and key.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// What the parameters are, in 32 bytes: equal numbers, units and origins give equal digests, whatever the file looks like.
    pub fn digest(&self) -> &ParameterDigest {
        &self.digest
    }

    /// Refuses numbers that are each in range and contradict each other.
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
                    "at most {greatest:.3}: what the force law holds for with a ball of {GREATEST_INDENTER_MM} mm on a layer of {} mm",
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

/// The largest ball that sensors are pressed with.
pub(crate) const GREATEST_INDENTER_MM: f64 = 10.0;
