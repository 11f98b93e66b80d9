//! Control port of a test: mounts specimens, sets the light, injects faults and returns the true state; one JSON value per line.
//!
//! ```text
//! {"mount": {"ball_mm": 4}}
//! {"mount": {"grating": "line", "spacing_mm": 1.5}}
//! {"light": "S1"}
//! {"inject": {"device": "force", "fault": "silent", "seconds": 0.5}}
//! {"inject": {"fault": "emergency-stop"}}
//! {"lag": {"device": "camera", "ms": 40}}
//! {"watch": {"Fz_N": 0.8}}
//! {"jog": {"by_mm": [8, 0, -10]}}
//! "truth"
//! ```
//!
//! Each request is answered by one line: `{"ok": true, …}` or `{"ok": false, "error": "…"}`.

use std::io::{self, BufRead, BufReader, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use serde::Deserialize;
use serde_json::{Value, json};
use taceva_core::{GratingKind, Nanometre, Speed};
use taceva_sim::Mounted;
use taceva_sim::optics::AmbientLight;

use crate::bench::WallBench;
use crate::error::WireError;
use crate::fault::{Arm, ArmFault, Device, Fault, FaultKind};
use crate::server::{End, Server};

/// Request on the control port.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Request {
    Mount(Specimen),
    Light(String),
    Inject(Injection),
    Lag(Lag),
    Watch(Limit),
    Jog(Jog),
    Truth,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Specimen {
    /// Radius of a ball, mm; `None` for a board.
    ball_mm: Option<f64>,
    grating: Option<String>,
    spacing_mm: Option<f64>,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Injection {
    device: Option<String>,
    fault: String,
    seconds: Option<f64>,
}

/// Latency of everything that the device streams.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Lag {
    device: String,
    ms: f64,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Limit {
    #[serde(rename = "Fz_N")]
    fz_n: Option<f64>,
}

/// Motion of the tip by hand, along x, y and z of the sensor; z points into the gel.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Jog {
    by_mm: [f64; 3],
}

/// Control port of a bench; listens until drop.
#[derive(Debug)]
pub struct Control {
    server: Server,
}

/// Maximum length of a request, bytes.
const LINE_MAX: u64 = 4096;
/// Default duration of a fault, s.
const USUAL_SECONDS: f64 = 1.0;
/// Maximum latency, ms.
const LAG_MAX_MS: f64 = 1e3;
/// Maximum travel of a jog along each axis, mm. The speed is [`JOG_MM_S`], mm/s.
const JOG_MAX_MM: f64 = 100.0;
const JOG_MM_S: f64 = 20.0;
/// Interval between checks whether a jog has ended.
const LOOK: Duration = Duration::from_millis(5);
/// Maximum duration of a fault, s.
const SECONDS_MAX: f64 = 3600.0;

impl Control {
    /// Listens for requests about `bench` and its arm, if any; port 0 selects any free port.
    ///
    /// # Errors
    /// [`WireError`] if the server cannot listen on the port.
    pub fn start(
        bench: &WallBench,
        arm: Option<Arc<dyn Arm>>,
        host: Ipv4Addr,
        port: u16,
    ) -> Result<Control, WireError> {
        let end = End::default();
        let serving = (bench.clone(), end.clone());
        let server = Server::start(host, port, &end, move |stream| {
            // A closed client ends its connection.
            let _ = serve(stream, &serving.0, arm.as_deref(), &serving.1);
        })?;
        Ok(Control { server })
    }

    /// Address of the port.
    pub fn address(&self) -> SocketAddr {
        self.server.address()
    }
}

fn serve(
    mut stream: TcpStream,
    bench: &WallBench,
    arm: Option<&dyn Arm>,
    end: &End,
) -> io::Result<()> {
    let mut lines = BufReader::new(stream.try_clone()?);
    let mut line = Vec::new();
    while !end.has_come() {
        let left = LINE_MAX.saturating_sub(line.len() as u64);
        match io::Read::take(&mut lines, left).read_until(b'\n', &mut line) {
            Ok(0) => return Ok(()),
            Ok(_) => {}
            Err(error)
                if [io::ErrorKind::WouldBlock, io::ErrorKind::TimedOut].contains(&error.kind()) =>
            {
                continue;
            }
            Err(error) => return Err(error),
        }
        let answer = answer(&line, bench, arm);
        line.clear();
        let answer = match answer {
            Ok(mut value) => {
                value["ok"] = true.into();
                value
            }
            Err(error) => json!({"ok": false, "error": error.to_string()}),
        };
        stream.write_all(format!("{answer}\n").as_bytes())?;
    }
    Ok(())
}

/// Executes a request and returns the answer.
fn answer(line: &[u8], bench: &WallBench, arm: Option<&dyn Arm>) -> Result<Value, WireError> {
    let refused = |why: String| WireError::Request(why);
    let request: Request =
        serde_json::from_slice(line).map_err(|error| refused(error.to_string()))?;
    match request {
        Request::Mount(specimen) => {
            let mounted = mounted(&specimen)?;
            bench
                .mount(mounted)
                .map_err(|error| refused(error.to_string()))?;
        }
        Request::Light(scene) => {
            let light = AmbientLight::from_name(&scene).ok_or_else(|| {
                let known = AmbientLight::ALL.map(AmbientLight::name).join("`, `");
                refused(format!("light {scene:?}: expected one of `{known}`"))
            })?;
            bench.light(light);
        }
        Request::Inject(injection) => inject(&injection, bench, arm)?,
        Request::Lag(Lag { device, ms }) => {
            let device = named_device(&device)?;
            if !(0.0..=LAG_MAX_MS).contains(&ms) {
                return Err(refused(format!("{ms} ms: expected 0 to {LAG_MAX_MS}")));
            }
            bench.set_lag(device, Duration::from_secs_f64(ms / 1e3));
        }
        Request::Watch(Limit { fz_n }) => bench.watch(fz_n),
        Request::Jog(Jog { by_mm }) => jog(by_mm, bench)?,
        Request::Truth => {
            let truth = bench.truth();
            let seconds = |time: Option<Duration>| time.map(|time| time.as_secs_f64());
            return Ok(json!({
                "simulated": true,
                "serial": bench.serial(),
                "now_s": bench.now().as_secs_f64(),
                "tip_mm": truth.tip_mm,
                "force_N": truth.force_n,
                "moving": truth.is_moving,
                "way_mm": truth.way_mm,
                "moved_s": truth.moved.as_secs_f64(),
                "depth_mm": truth.depth_mm,
                "deepest_mm": truth.deepest_mm,
                "passed_s": seconds(truth.passed),
                "stopped_s": seconds(truth.stopped),
            }));
        }
    }
    Ok(json!({}))
}

/// Moves the tip as a person with the robot's pendant would, and waits until the tip rests.
fn jog(by_mm: [f64; 3], bench: &WallBench) -> Result<(), WireError> {
    let refused = WireError::Request;
    if let Some(mm) = by_mm.iter().find(|mm| mm.abs() > JOG_MAX_MM) {
        return Err(refused(format!(
            "{mm} mm: expected {} to {JOG_MAX_MM}",
            -JOG_MAX_MM
        )));
    }
    let speed = Speed::try_new(JOG_MM_S).map_err(|error| refused(error.to_string()))?;
    let mut target = bench.pose();
    target.position.x.0 += by_mm[0];
    target.position.y.0 += by_mm[1];
    target.position.z.0 += by_mm[2];
    bench.set_out(target, speed);
    while bench.is_moving() {
        std::thread::sleep(LOOK);
    }
    Ok(())
}

fn mounted(specimen: &Specimen) -> Result<Mounted, WireError> {
    let refused = WireError::Request;
    let length = |mm: f64| {
        Nanometre::from_millimetres(mm)
            .ok_or_else(|| refused(format!("{mm} mm is not a valid length")))
    };
    match specimen {
        Specimen {
            ball_mm: Some(radius_mm),
            grating: None,
            spacing_mm: None,
        } => Mounted::ball(length(*radius_mm)?),
        Specimen {
            ball_mm: None,
            grating: Some(kind),
            spacing_mm: Some(spacing_mm),
        } => {
            let kind = GratingKind::from_name(kind)
                .ok_or_else(|| refused(format!("grating {kind:?}: expected `line` or `dot`")))?;
            Mounted::board(kind, length(*spacing_mm)?)
        }
        _ => {
            let expected = "a specimen is `ball_mm`, or `grating` and `spacing_mm`";
            return Err(refused(expected.to_owned()));
        }
    }
    .map_err(|error| refused(error.to_string()))
}

fn inject(
    injection: &Injection,
    bench: &WallBench,
    arm: Option<&dyn Arm>,
) -> Result<(), WireError> {
    let refused = WireError::Request;
    let of_arm = match injection.fault.as_str() {
        "emergency-stop" => Some(ArmFault::EmergencyStop),
        "collision" => Some(ArmFault::Collision),
        _ => None,
    };
    if let Some(fault) = of_arm {
        let arm = arm.ok_or_else(|| refused("this bench has no arm".to_owned()))?;
        arm.suffer(fault);
        return Ok(());
    }
    let device = named_device(injection.device.as_deref().unwrap_or_default())?;
    let kind = FaultKind::ALL
        .into_iter()
        .find(|kind| kind.name() == injection.fault)
        .ok_or_else(|| {
            let known = FaultKind::ALL.map(FaultKind::name).join("`, `");
            refused(format!(
                "fault {:?}: expected one of `{known}`, `emergency-stop`, `collision`",
                injection.fault
            ))
        })?;
    let seconds = injection.seconds.unwrap_or(USUAL_SECONDS);
    if !(0.0..=SECONDS_MAX).contains(&seconds) {
        return Err(refused(format!("{seconds} s: expected 0 to {SECONDS_MAX}")));
    }
    bench.inject(Fault {
        device,
        kind,
        lasts: Duration::from_secs_f64(seconds),
    });
    Ok(())
}

fn named_device(name: &str) -> Result<Device, WireError> {
    let device = Device::ALL.into_iter().find(|device| device.name() == name);
    device.ok_or_else(|| {
        let known = Device::ALL.map(Device::name).join("`, `");
        WireError::Request(format!("device {name:?}: expected one of `{known}`"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::BenchOptions;

    #[test]
    fn a_jog_moves_the_tip_along_the_axes_of_the_sensor_and_ends_at_rest() {
        let bench = WallBench::start(&BenchOptions::quiet(1)).expect("a bench");
        let tip_mm = || {
            let truth = answer(b"\"truth\"", &bench, None).expect("the truth");
            [0, 1, 2].map(|axis: usize| truth["tip_mm"][axis].as_f64().expect("a length"))
        };
        let before = tip_mm();
        answer(br#"{"jog": {"by_mm": [2, -1, -0.5]}}"#, &bench, None).expect("it moved");
        assert!(!bench.is_moving());
        let after = tip_mm();
        for (axis, by_mm) in [2.0, -1.0, -0.5].into_iter().enumerate() {
            let moved_mm = after[axis] - before[axis];
            assert!((moved_mm - by_mm).abs() < 0.05, "{axis}: {moved_mm} mm");
        }
        let far = answer(br#"{"jog": {"by_mm": [0, 0, 101]}}"#, &bench, None);
        let said = far.expect_err("too far").to_string();
        assert!(said.contains("101 mm: expected -100 to 100"), "{said}");
    }

    #[test]
    fn requests_are_done_or_refused_by_what_would_be_accepted() {
        let bench = WallBench::start(&BenchOptions::quiet(1)).expect("a bench");
        let ask = |line: &str| answer(line.as_bytes(), &bench, None);
        for line in [
            r#"{"mount": {"ball_mm": 4}}"#,
            r#"{"mount": {"grating": "line", "spacing_mm": 1.5}}"#,
            r#"{"light": "S1"}"#,
            r#"{"inject": {"device": "force", "fault": "silent", "seconds": 0.5}}"#,
            r#"{"lag": {"device": "camera", "ms": 40}}"#,
            r#"{"watch": {"Fz_N": 0.8}}"#,
        ] {
            ask(line).unwrap_or_else(|error| panic!("{line}: {error}"));
        }
        let truth = ask("\"truth\"").expect("the truth");
        assert_eq!(truth["serial"], "TACEVA-SIM0001");
        assert_eq!(truth["simulated"], true);
        for (line, words) in [
            ("", "EOF"),
            ("{}", "expected"),
            (r#"{"mount": {"ball_mm": 5}}"#, "expected 2, 4 or 10 mm"),
            (r#"{"mount": {}}"#, "a specimen is"),
            (r#"{"light": "sun"}"#, "expected one of `normal`"),
            (
                r#"{"inject": {"fault": "silent"}}"#,
                "`robot`, `force`, `camera`",
            ),
            (
                r#"{"inject": {"device": "force", "fault": "gone"}}"#,
                "`drop`, `late`",
            ),
            (r#"{"inject": {"fault": "collision"}}"#, "no arm"),
            (
                r#"{"inject": {"device": "force", "fault": "drop", "seconds": -1}}"#,
                "0 to 3600",
            ),
            (r#"{"lag": {"device": "gel", "ms": 4}}"#, "`robot`, `force`"),
            (r#"{"lag": {"device": "force", "ms": -4}}"#, "0 to 1000"),
            (r#"{"tare": {}}"#, "unknown variant"),
        ] {
            let error = ask(line).expect_err(line).to_string();
            assert!(error.contains(words), "{line}: {error}");
        }
    }
}
