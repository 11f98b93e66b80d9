//! Drivers that do what their arguments ask for, good and bad.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use taceva_core::{
    Access, ArgSpec, ArgValue, Args, Axes, Channels, Deadline, Degree, Descriptor, DescriptorError,
    DescriptorSpec, DriverError, DriverKey, DriverSource, ErrorKind, Factory, Facts, FeatureShape,
    Features, ForceFacts, ForceTransducer, Found, FrameInfo, FrameMut, Guard, GuardedMotion,
    GuardedStop, Halt, Interrupt, Lighting, LightingFacts, Millimetre, ModelError, Newton,
    PixelFormat, Point, Pose, Regressor, Rig, Robot, RobotFacts, Saved, SavedRegressor, Sensor,
    SensorFacts, SimulatedBench, Specimen, Speed, Stamp, Tare, Workspace, Wrench,
};
use taceva_plugin::{EstimatorFactory, FitRequest, HaltLatch, Interruption, export_plugin};

const KEY: DriverKey = DriverKey::fixed("test/device");
const FRAME: FrameInfo = FrameInfo {
    width: 4,
    height: 3,
    format: PixelFormat::Rgb8,
};

export_plugin! {
    id: "org.example.test",
    drivers: [
        dyn Sensor => || Ok(Box::new(SensorMaker::new()?)),
        dyn Robot => || Ok(Box::new(RobotMaker::new()?)),
        dyn ForceTransducer => || Ok(Box::new(ForceMaker::new()?)),
        dyn Lighting => || Ok(Box::new(LightingMaker::new()?)),
        dyn EstimatorFactory => || Box::new(MeanMaker::new()),
    ],
}

fn descriptor(
    word: &'static str,
    facts: Facts,
    arguments: Vec<ArgSpec>,
) -> Result<Descriptor, DescriptorError> {
    let key = format!("test/{word}").parse().expect("a key");
    DescriptorSpec::new(key, word, DriverSource::Simulated, facts)
        .arguments(arguments)
        .check()
}

fn way() -> Vec<ArgSpec> {
    let ways = ["well", "panic", "nan", "refuse", "block", "panic-at-drop"];
    vec![ArgSpec::choice("way", ways).default(ArgValue::Text("well".to_owned()))]
}

fn error(kind: ErrorKind) -> DriverError {
    DriverError::new(kind, &KEY, "do it")
}

struct SensorMaker(Descriptor);

impl SensorMaker {
    fn new() -> Result<SensorMaker, DescriptorError> {
        let facts = SensorFacts {
            frame: Some(FRAME),
            ..SensorFacts::default()
        };
        Ok(SensorMaker(descriptor(
            "palm",
            Facts::Sensor(Box::new(facts)),
            way(),
        )?))
    }
}

impl Factory<dyn Sensor> for SensorMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        let way = args.text("way").to_owned();
        Ok(Box::new(Palm {
            way,
            interruption: Arc::default(),
            captured: 0,
            light: "dark".to_owned(),
            scenes: vec!["dark".to_owned(), "room".to_owned()],
        }))
    }
    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        let arguments = "way=well".to_owned();
        Ok(vec![Found {
            driver: KEY,
            title: "palm".to_owned(),
            arguments,
            access: Access::Ready,
        }])
    }
}

struct Palm {
    way: String,
    interruption: Arc<Interruption>,
    captured: u64,
    light: String,
    scenes: Vec<String>,
}

impl Sensor for Palm {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }
    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        match self.way.as_str() {
            "panic" => panic!("frame {}", self.captured),
            "refuse" => return Err(error(ErrorKind::Disconnected).because("the cable is out")),
            "block" => {
                let call = self.interruption.call();
                call.rest(deadline.remaining())
                    .map_err(|interrupted| error(ErrorKind::Interrupted).because(interrupted))?;
                return Err(error(ErrorKind::Timeout));
            }
            _ => {}
        }
        self.captured += 1;
        into.bytes_mut()
            .fill(if self.light == "dark" { 1 } else { 200 });
        let valid_s = if self.way == "nan" { f64::NAN } else { 1.5 };
        Ok(Stamp {
            valid_s,
            received_s: None,
        })
    }
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interruption.handle()
    }
    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        (self.way == "well").then_some(self as &mut dyn Lighting)
    }
}

impl Lighting for Palm {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }
    fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
        if self.scenes.iter().all(|known| known != scene) {
            return Err(error(ErrorKind::InvalidArgument).because(format!("no scene {scene}")));
        }
        self.light = scene.to_owned();
        Ok(())
    }
}

impl Drop for Palm {
    fn drop(&mut self) {
        assert_ne!(self.way, "panic-at-drop", "dropped");
    }
}

struct RobotMaker(Descriptor);

impl RobotMaker {
    fn new() -> Result<RobotMaker, DescriptorError> {
        Ok(RobotMaker(descriptor(
            "arm",
            Facts::Robot(limits()),
            way(),
        )?))
    }
}

/// Half a metre around the gel, at 100 mm/s.
fn limits() -> RobotFacts {
    let corner = |side| Point {
        x: Millimetre(side),
        y: Millimetre(side),
        z: Millimetre(side),
    };
    RobotFacts {
        workspace: Some(Workspace {
            least: corner(-500.0),
            greatest: corner(500.0),
        }),
        speed_max: Speed::try_new(100.0).ok(),
        ..RobotFacts::default()
    }
}

impl Factory<dyn Robot> for RobotMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        rig.offer_bench("test bench", Arc::new(Table));
        Ok(Box::new(Arm {
            way: args.text("way").to_owned(),
            latch: Arc::default(),
            stands: Pose::default(),
        }))
    }
}

struct Arm {
    way: String,
    latch: Arc<HaltLatch>,
    stands: Pose,
}

impl Robot for Arm {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let mut pose = self.stands;
        if self.way == "nan" {
            pose.rotation.y = Degree(f64::NAN);
        }
        Ok((pose, Stamp::at(Duration::from_secs(2))))
    }
    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let time = match self.way.as_str() {
            "block" => deadline.remaining(),
            "panic" => panic!("motor"),
            _ => Duration::ZERO,
        };
        self.latch
            .rest(time)
            .map_err(|halted| error(ErrorKind::Interrupted).because(halted))?;
        if self.way == "block" {
            return Err(error(ErrorKind::Timeout));
        }
        self.stands = target;
        Ok(Stamp::at(Duration::from_secs_f64(speed.mm_per_s())))
    }
    fn halt_handle(&self) -> Arc<dyn Halt> {
        self.latch.handle()
    }
    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.latch.clear();
        Ok(())
    }
    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        Some(self)
    }
}

impl GuardedMotion for Arm {
    fn move_guarded(
        &mut self,
        mut target: Pose,
        _: Speed,
        guard: Guard,
        _: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let stamp = Stamp::at(Duration::from_secs(3));
        if guard.force > Newton(5.0) {
            return Ok(GuardedStop::Arrived { stamp });
        }
        target.position.z.0 /= 2.0;
        Ok(GuardedStop::Guarded {
            pose: target,
            stamp,
        })
    }
}

struct ForceMaker(Descriptor);

impl ForceMaker {
    fn new() -> Result<ForceMaker, DescriptorError> {
        let facts = ForceFacts {
            axes: Axes::SIX,
            tare: true,
            ..ForceFacts::default()
        };
        Ok(ForceMaker(descriptor("wrist", Facts::Force(facts), way())?))
    }
}

impl Factory<dyn ForceTransducer> for ForceMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        Ok(Box::new(Wrist {
            way: args.text("way").to_owned(),
            zero: 0.0,
        }))
    }
}

struct Wrist {
    way: String,
    zero: f64,
}

impl ForceTransducer for Wrist {
    fn axes(&self) -> Axes {
        Axes::SIX
    }
    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        if self.way == "block" {
            // Nothing ends this but its time: a driver that cannot be interrupted.
            thread::sleep(deadline.remaining().min(Duration::from_millis(200)));
            return Err(error(ErrorKind::Timeout));
        }
        let mut wrench = Wrench::default();
        wrench.force[2] = Newton(if self.way == "nan" {
            f64::NAN
        } else {
            4.0 - self.zero
        });
        wrench.torque[0].0 = 12.5;
        Ok((wrench, Stamp::at(Duration::from_nanos(1_234_567_891))))
    }
    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for Wrist {
    fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.zero = 4.0;
        Ok(())
    }
}

struct LightingMaker(Descriptor);

impl LightingMaker {
    fn new() -> Result<LightingMaker, DescriptorError> {
        let facts = LightingFacts {
            scenes: vec!["dark".to_owned()],
        };
        Ok(LightingMaker(descriptor(
            "lamp",
            Facts::Lighting(facts),
            way(),
        )?))
    }
}

impl Factory<dyn Lighting> for LightingMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn Lighting>, DriverError> {
        Err(error(ErrorKind::PermissionDenied).because("not for you"))
    }
}

/// A bench whose clock stands still.
struct Table;

impl SimulatedBench for Table {
    fn now(&self) -> Duration {
        Duration::from_nanos(77)
    }
    fn rest(&self, _: Duration) -> Result<(), DriverError> {
        Ok(())
    }
    fn mount(&self, specimen: Specimen) -> Result<(), DriverError> {
        match specimen {
            Specimen::Sphere { .. } => Ok(()),
            grating => Err(error(ErrorKind::InvalidArgument).because(grating.to_string())),
        }
    }
    fn name_press(&self, _: u64) -> Result<(), DriverError> {
        Ok(())
    }
    fn schedule(&self, _: Duration) -> Result<(), DriverError> {
        Ok(())
    }
    fn provenance(&self) -> Option<String> {
        Some("a table".to_owned())
    }
}

struct MeanMaker {
    key: DriverKey,
    settings: Vec<ArgSpec>,
}

impl MeanMaker {
    fn new() -> MeanMaker {
        MeanMaker {
            key: DriverKey::fixed("org.example.test/mean"),
            settings: vec![ArgSpec::number("shift", -1.0, 1.0).default(ArgValue::Number(0.0))],
        }
    }
}

impl EstimatorFactory for MeanMaker {
    fn key(&self) -> &DriverKey {
        &self.key
    }
    fn title(&self) -> &str {
        "the mean of what was seen"
    }
    fn settings(&self) -> &[ArgSpec] {
        &self.settings
    }
    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let targets = request.training.targets;
        let columns = targets.channels.len();
        let samples = request.training.features.samples();
        let mut means = vec![request.settings.number("shift"); columns];
        request.progress.begin("add", Some(samples as u64));
        for row in targets.values.chunks_exact(columns) {
            if request.progress.is_cancelled() {
                return Err(ModelError::new(
                    ErrorKind::Interrupted,
                    "the fit was cancelled",
                ));
            }
            for (mean, value) in means.iter_mut().zip(row) {
                #[expect(clippy::cast_precision_loss, reason = "few samples")]
                let count = samples as f64;
                *mean += value / count;
            }
            request.progress.advance(1);
        }
        Ok(Box::new(Mean {
            channels: targets.channels.clone(),
            shape: request.training.features.shape(),
            means,
        }))
    }
    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        if saved.bytes.len() != 8 * saved.channels.len() {
            return Err(ModelError::new(
                ErrorKind::Protocol,
                "no means of that many channels",
            ));
        }
        let means = saved
            .bytes
            .chunks_exact(8)
            .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight")))
            .collect();
        Ok(Box::new(Mean {
            channels: saved.channels.clone(),
            shape: saved.shape,
            means,
        }))
    }
}

struct Mean {
    channels: Channels,
    shape: FeatureShape,
    means: Vec<f64>,
}

impl Regressor for Mean {
    fn channels(&self) -> &Channels {
        &self.channels
    }
    fn shape(&self) -> FeatureShape {
        self.shape
    }
    fn predict(&self, _: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        for row in into.chunks_exact_mut(self.means.len()) {
            row.copy_from_slice(&self.means);
        }
        Ok(())
    }
}

impl SavedRegressor for Mean {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        Ok(self
            .means
            .iter()
            .flat_map(|mean| mean.to_le_bytes())
            .collect())
    }
}
