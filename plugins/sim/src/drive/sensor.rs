//! A simulated sensor.

mod description;

use self::description::{bits, default_reduction, describe, fault, frame, key, reduced, reduction};

use std::time::Duration;

use taceva_core::{
    ArgValue, Args, Deadline, Descriptor, DescriptorError, DriverError, DriverKey, ErrorKind,
    Factory, FrameInfo, FrameMut, Lighting, Rig, Sensor, Stamp,
};

use super::error::{failed, rig_name};
use super::lighting::Lamps;
use super::rig::SimulatedRig;
use super::specimen::Mounted;
use super::state::State;
use crate::bench::Bench;
use crate::contact::BOARD_SIDE_MM;
use crate::optics::{AmbientLight, Board, Camera, OpticsSpec, Stimulus, View};
use crate::parameters::{Model, ParameterError, Parameters};
use crate::specimen::GratingPose;

/// Opens simulated sensors of one model.
#[derive(Debug)]
pub struct SensorFactory {
    model: Model,
    descriptor: Descriptor,
}

impl SensorFactory {
    /// Creates the factory of a built-in model, such as `sim/gelsight`.
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

    /// Parameters of the table in the argument `table`, by default the table of the model. The arguments for gel faults, `quiet` and `ages` change
    /// these parameters.
    fn parameters(&self, args: &Args) -> Result<Parameters, String> {
        let table = args.get("table").and_then(ArgValue::as_text);
        let table = table.unwrap_or(self.model.table());
        let worn = fault(args).map(|(fault, severity)| {
            let worn = Parameters::worn_table(table, fault, severity);
            worn.map_err(|error| format!("`{}` of severity {severity}: {error}", fault.name()))
        });
        let worn = worn.transpose()?;
        let table = worn.as_deref().unwrap_or(table);
        let aged = match args.flag("ages") {
            true => Parameters::ageing_table(table).map(Some),
            false => Ok(None),
        };
        let refused = |error: ParameterError| format!("invalid `table`: {error}");
        let aged = aged.map_err(refused)?;
        let table = aged.as_deref().unwrap_or(table);
        let parameters = match args.flag("quiet") {
            true => Parameters::parse_quiet(table),
            false => Parameters::parse(table),
        };
        let parameters = parameters.map_err(refused)?;
        Ok(match aged {
            Some(_) => parameters.aged(args.number("load_kn")),
            None => parameters,
        })
    }
}

impl Factory<dyn Sensor> for SensorFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        // An invalid table is rejected when the sensor is opened, with its own message.
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
        let unit =
            u32::try_from(args.whole("unit")).expect("the declared range of unit numbers is small");
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
                let why = format!("the bench `{}` already has a sensor", rig_name(args));
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

    /// Prepares the camera, so that the first picture takes no longer than later pictures.
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
            let why = "the sensor is not started".to_owned();
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

/// Current view of the camera.
pub(super) fn view(state: &mut State, is_transparent: bool) -> View {
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
