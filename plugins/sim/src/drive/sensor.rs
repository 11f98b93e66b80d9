//! A simulated sensor.

use std::time::Duration;

use taceva_core::{
    ArgSpec, ArgValue, Args, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverKey, DriverSource, ErrorKind, Factory, Facts, Footprint, FrameInfo, FrameMut, Hertz,
    Lighting, Millimetre, Newton, Rig, Sensor, SensorFacts, Stamp,
};

use super::error::{failed, rig_argument, rig_name};
use super::lighting::{Lamps, scenes};
use super::mounted::Mounted;
use super::rig::SimulatedRig;
use super::state::State;
use crate::bench::Bench;
use crate::contact::BOARD_SIDE_MM;
use crate::optics::{AmbientLight, Bits, Board, Camera, OpticsSpec, Stimulus, View};
use crate::parameters::{Body, Model, Outline, Parameters};
use crate::specimen::GratingPose;

/// Opens simulated sensors of one model.
#[derive(Debug)]
pub struct SensorFactory {
    model: Model,
    descriptor: Descriptor,
}

impl SensorFactory {
    /// The factory of a compiled-in model: `sim/gelsight` for one.
    ///
    /// # Errors
    /// [`DescriptorError`] if its description contradicts itself.
    pub fn new(model: Model) -> Result<SensorFactory, DescriptorError> {
        let parameters = model.parameters();
        let frame = frame(&parameters, default_reduction(&parameters), None);
        Ok(SensorFactory {
            model,
            descriptor: describe(model, &parameters, frame).check()?,
        })
    }

    /// The parameters that `args` ask for: those of the model, or the table they hold.
    fn parameters(&self, args: &Args) -> Result<Parameters, String> {
        match args.get("table").and_then(ArgValue::as_text) {
            None => Ok(self.model.parameters()),
            Some(table) => Parameters::parse(table)
                .map_err(|error| format!("the table of parameters, {error}")),
        }
    }
}

impl Factory<dyn Sensor> for SensorFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        // A table that does not read is refused when it is opened, in its own words.
        let parameters = self
            .parameters(args)
            .unwrap_or_else(|_| self.model.parameters());
        let frame = frame(&parameters, reduction(args, &parameters), bits(args));
        describe(self.model, &parameters, frame).check()
    }

    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        let driver = key(self.model);
        let doing = "open the sensor";
        let refused = |why: String| failed(ErrorKind::InvalidArgument, &driver, doing, why);
        let parameters = self.parameters(args).map_err(refused)?;
        let seed = args.whole("seed").unsigned_abs();
        let unit = u32::try_from(args.whole("unit"))
            .expect("its declaration keeps the number of a unit small");
        let spec = OpticsSpec::new(&parameters);
        let reduced = reduced(spec.native, reduction(args, &parameters));
        let camera = Camera::new(&spec, reduced, unit, seed)
            .map_err(|error| failed(ErrorKind::InvalidArgument, &driver, doing, error))?;
        let camera = match bits(args) {
            Some(bits) => camera.with_bits(bits),
            None => camera,
        };
        let rig = SimulatedRig::of(rig, rig_name(args));
        let period = Duration::from_secs_f64(1.0 / parameters.camera.rate_hz);
        {
            let mut state = rig.state();
            if state.sensor_is_open {
                let why = format!("the bench `{}` holds a sensor already", rig_name(args));
                return Err(failed(ErrorKind::Busy, &driver, doing, why));
            }
            state.install(Bench::new(parameters, unit, seed));
        }
        Ok(Box::new(SimulatedSensor {
            lamps: camera
                .is_transparent()
                .then(|| Lamps::new(rig.clone(), driver.clone())),
            camera,
            rig,
            driver,
            period,
            is_running: false,
        }))
    }
}

taceva_core::submit_builtin!(dyn Sensor, || Ok(Box::new(SensorFactory::new(
    Model::ViTacTip
)?)));
taceva_core::submit_builtin!(dyn Sensor, || Ok(Box::new(SensorFactory::new(
    Model::MagicTac
)?)));
taceva_core::submit_builtin!(dyn Sensor, || Ok(Box::new(SensorFactory::new(
    Model::GelSight
)?)));
taceva_core::submit_builtin!(dyn Sensor, || Ok(Box::new(SensorFactory::new(
    Model::GelSightWm
)?)));

struct SimulatedSensor {
    camera: Camera,
    lamps: Option<Lamps>,
    rig: SimulatedRig,
    driver: DriverKey,
    period: Duration,
    is_running: bool,
}

impl Sensor for SimulatedSensor {
    fn frame_info(&self) -> FrameInfo {
        self.camera.frame_info()
    }

    /// Makes what pictures need, so that the first one keeps its deadline as the later ones do.
    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.camera.prepare();
        self.is_running = true;
        Ok(())
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let refused = |kind, why: String| failed(kind, &self.driver, "capture a frame", why);
        let info = self.camera.frame_info();
        if into.info() != info {
            let why = format!("a buffer for {}, expected {info}", into.info());
            return Err(refused(ErrorKind::InvalidArgument, why));
        }
        if !self.is_running {
            let why = "it is not started".to_owned();
            return Err(refused(ErrorKind::InvalidArgument, why));
        }
        let mut state = self.rig.state();
        let wait = state.to_next_beat(self.period);
        if wait > deadline.remaining() {
            state.rest(deadline.remaining());
            let why = format!("no frame within {deadline}");
            return Err(refused(ErrorKind::Timeout, why));
        }
        state.rest(wait);
        let beat = state.now();
        let view = view(&mut state, self.lamps.is_some());
        drop(state);
        self.camera
            .render(&view, into)
            .map_err(|error| failed(ErrorKind::Internal, &self.driver, "capture a frame", error))?;
        Ok(Stamp::at(beat))
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.is_running = false;
        Ok(())
    }

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        let lamps = self.lamps.as_mut()?;
        Some(lamps)
    }
}

impl Drop for SimulatedSensor {
    fn drop(&mut self) {
        self.rig.state().sensor_is_open = false;
    }
}

/// What the camera sees now.
fn view(state: &mut State, is_transparent: bool) -> View {
    let stimulus = match state.mounted {
        Mounted::Ball(_) => match state.contact() {
            Some(contact) if contact.touches() => Stimulus::Ball(contact),
            _ => Stimulus::Nothing,
        },
        Mounted::Board(_) if !state.is_touching() => Stimulus::Nothing,
        Mounted::Board(grating) => {
            let stand = state.board();
            let [x, y, _] = state.tip_mm();
            Stimulus::Board(Board {
                grating,
                pose: GratingPose {
                    yaw_degree: state.sent().rotation.z.0,
                    offset_mm: [x, y],
                },
                pressure_mpa: stand.force_n / (BOARD_SIDE_MM * BOARD_SIDE_MM),
                depth_mm: stand.depth_mm,
                young_modulus_mpa: stand.young_modulus_mpa,
            })
        }
    };
    let (press, picture) = state.next_picture();
    View {
        stimulus,
        light: if is_transparent {
            state.light
        } else {
            AmbientLight::Normal
        },
        press,
        picture,
    }
}

fn key(model: Model) -> DriverKey {
    match model {
        Model::ViTacTip => DriverKey::fixed("sim/vitactip"),
        Model::MagicTac => DriverKey::fixed("sim/magictac"),
        Model::GelSight => DriverKey::fixed("sim/gelsight"),
        Model::GelSightWm => DriverKey::fixed("sim/gelsight-wm"),
    }
}

fn describe(model: Model, parameters: &Parameters, frame: Option<FrameInfo>) -> DescriptorSpec {
    let depth_max_mm = parameters.probing.depth_max_mm;
    let footprint = match parameters.outline() {
        Outline::Disc { radius_mm } => Footprint::disc(radius_mm, Some(depth_max_mm)),
        Outline::Rectangle { half_mm: [x, y] } => Footprint::rectangle(x, y, Some(depth_max_mm)),
    };
    let surface = &parameters.surface;
    let is_transparent = parameters.camera.transparency > 0.5;
    let facts = SensorFacts {
        frame,
        rate: Some(Hertz(parameters.camera.rate_hz)),
        opaque: Some(!is_transparent),
        markers: Some(parameters.markers.is_some() || parameters.lattice.is_some()),
        scenes: if is_transparent { scenes() } else { Vec::new() },
        footprint: footprint.ok(),
        depth_max: Some(Millimetre(depth_max_mm)),
        force_max: Some(Newton(parameters.probing.force_max_n)),
        camera: Some([parameters.camera.width_px, parameters.camera.height_px].map(pixels)),
        gel_thickness: match parameters.body {
            Body::Layer(layer) => Some(Millimetre(layer.thickness_mm)),
            Body::Dome(_) => None,
        },
        field_of_view_mm2: Some(match parameters.body {
            Body::Layer(_) => surface.width_mm * surface.height_mm,
            Body::Dome(_) => std::f64::consts::FRAC_PI_4 * surface.width_mm * surface.height_mm,
        }),
    };
    DescriptorSpec::new(
        key(model),
        format!("simulated {}", parameters.name),
        DriverSource::Simulated,
        Facts::Sensor(Box::new(facts)),
    )
    .arguments([
        rig_argument(),
        ArgSpec::whole("seed", 0, i64::MAX)
            .default(ArgValue::Whole(0))
            .help("what all noise of the bench is drawn from"),
        ArgSpec::whole("unit", 0, UNITS)
            .default(ArgValue::Whole(0))
            .help("the specimen of the sensor; 0 is nominal"),
        ArgSpec::whole("reduction", 1, REDUCTIONS)
            .optional()
            .help("how many pixels of the camera, along x and along y, make one of the frame")
            .changes_facts(),
        ArgSpec::choice("bits", Bits::ALL.map(Bits::name))
            .optional()
            .help("bits of a sample, 8 where the frame has the size of the camera and 16 where it is reduced, if nothing is said")
            .changes_facts(),
        ArgSpec::text("table")
            .optional()
            .help("a table of parameters in the place of the compiled-in one, its whole text")
            .changes_facts(),
    ])
}

/// Numbers of units.
const UNITS: i64 = 1_000_000;
/// The greatest reduction.
const REDUCTIONS: i64 = 64;
/// Frames are reduced to about so many pixels along their longer side, if nothing else is asked for.
const LONGER_SIDE: u32 = 160;

fn reduction(args: &Args, parameters: &Parameters) -> u32 {
    match args.get("reduction") {
        Some(&ArgValue::Whole(reduction)) => u32::try_from(reduction).unwrap_or(1),
        _ => default_reduction(parameters),
    }
}

fn default_reduction(parameters: &Parameters) -> u32 {
    let [width, height] = OpticsSpec::new(parameters).native;
    (width.max(height) / LONGER_SIDE).clamp(1, 64)
}

fn reduced(native: [u32; 2], reduction: u32) -> [u32; 2] {
    native.map(|side| (side / reduction).max(1))
}

/// The bits of a sample that `args` ask for.
fn bits(args: &Args) -> Option<Bits> {
    let name = args.get("bits").and_then(ArgValue::as_text)?;
    Bits::ALL.into_iter().find(|bits| bits.name() == name)
}

/// The frame of such a sensor; `None` if there is none, which opening it says in detail.
fn frame(parameters: &Parameters, reduction: u32, bits: Option<Bits>) -> Option<FrameInfo> {
    let spec = OpticsSpec::new(parameters);
    let info = spec.frame_info(reduced(spec.native, reduction)).ok()?;
    Some(bits.map_or(info, |bits| bits.of(info)))
}

fn pixels(count: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "parameters are checked to lie between 16 and 16,384"
    )]
    let count = count.round() as u32;
    count
}
