//! The built-in driver `camera/mjpeg`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, ErrorKind, Factory, Facts, Hertz, Rig, Sensor, submit_builtin,
};

use super::KEY;
use super::camera::Camera;
use super::url::Url;
use crate::arguments::optional_number;
use crate::camera::preset::Preset;

submit_builtin!(dyn Sensor, || Ok(Box::new(MjpegFactory::new()?)));

/// Opens cameras that stream JPEG (or PNG) over HTTP: `camera/mjpeg:url=http://192.168.1.20:8080/?action=stream`.
///
/// # The physical contract
/// - Opening connects and waits for a first image, which determines the size and format of every frame. A frame of another size is an error of that
///   frame. The connection lasts until the sensor is dropped; `start` reconnects to a lost camera.
/// - A frame is the newest image received; images that no capture reads in time are missed. The stamp of a frame is the arrival time of its first
///   bytes, on the monotonic clock. Exposure and compression in the camera happen earlier and are not included.
/// - With `clock=server` the stamp is the server's time of each picture (`X-Timestamp` of `ustreamer` and `mjpg-streamer`), plus the least delay of
///   the first 32 frames. Delays of the link then do not scatter the stamps, but a drift of the server's clock remains in them. A step of that clock
///   by more than 10 s, as after a restart, is an error until the sensor is opened again.
/// - The driver sets nothing: exposure, gain, white balance and focus must be fixed at the camera's server.
/// - Only plain HTTP without a password is supported. Redirections are not followed.
///
/// # Verification
/// Tests use ffmpeg as a server (`-f mpjpeg -listen 1`), and streams in the formats of `ustreamer` and `mjpg-streamer`. The streams state the
/// boundary in the header or only in the body. Some state image lengths, and some are chunked. The driver passes its suite on an emulated camera with
/// each format. **Not verified without the device**: the latency and the automatic settings of a camera.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::camera::mjpeg::MjpegFactory;
/// let factory = MjpegFactory::new()?;
/// assert!(factory.descriptor().args("url=http://127.0.0.1:8080/?action=stream").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct MjpegFactory {
    descriptor: Descriptor,
}

impl MjpegFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the built-in descriptor is inconsistent. Tests exclude this case.
    pub fn new() -> Result<MjpegFactory, DescriptorError> {
        let arguments = [
            ArgSpec::text("url").help("URL of the stream: http://host:port/path"),
            Preset::argument(&KEY),
            ArgSpec::number("rate", 0.1, 10_000.0)
                .unit("Hz")
                .optional()
                .help("frames per second that the camera sends, if known")
                .changes_facts(),
            ArgSpec::choice("clock", ["arrival", "server"])
                .default(ArgValue::Text("arrival".to_owned()))
                .help("time of a frame: its arrival, or the `X-Timestamp` of the server"),
        ];
        let facts = Facts::Sensor(Box::default());
        let title = "a camera that streams over HTTP";
        let spec = DescriptorSpec::new(KEY, title, DriverSource::Real, facts);
        Ok(MjpegFactory {
            descriptor: spec.arguments(arguments).check()?,
        })
    }
}

impl Factory<dyn Sensor> for MjpegFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        if let Facts::Sensor(facts) = &mut spec.facts {
            let preset = preset(args);
            let rate_hz = optional_number(args, "rate").or(preset.map(|preset| preset.rate_hz));
            facts.rate = rate_hz.map(Hertz);
            facts.camera = preset.map(|preset| [preset.width, preset.height]);
        }
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        let url: Url = args.text("url").parse().map_err(|error| {
            DriverError::new(ErrorKind::InvalidArgument, &KEY, "connect to the camera")
                .because(error)
        })?;
        let is_stamping = args.text("clock") == "server";
        Ok(Box::new(Camera::open(url, preset(args), is_stamping)?))
    }
}

fn preset(args: &Args) -> Option<&'static Preset> {
    let name = args.get("preset").and_then(ArgValue::as_text)?;
    Preset::named(&KEY, name)
}
