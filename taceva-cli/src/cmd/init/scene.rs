//! Writes a scene of the simulated bench, or of a real rig with the sensing area.

use std::path::Path;

use taceva_acquire::{Overrides, PlannedScene, SceneText};
use taceva_core::{DriverKind, DriverSource};
use taceva_dataset::internal::quoted;
use taceva_drivers::{ListedDriver, devices};
use taceva_protocol::Scene;

use super::{Context, Interview, Usage, finish, target};
use crate::args::InitTarget;

/// Devices of the simulated bench except its sensors.
const BENCH: &str =
    "[robot]\ndriver = \"sim/robot\"\n\n[force]\ndriver = \"sim/force-transducer\"\n";

pub(super) fn write(
    args: &InitTarget,
    interview: &mut Interview,
    context: &Context,
) -> anyhow::Result<u8> {
    let path = target(args, "scene.toml")?;
    let drivers = context.drivers(None)?;
    let listed = devices(&drivers);
    let is_simulated_sensor = |driver: &&ListedDriver| {
        driver.kind == DriverKind::Sensor && driver.source == DriverSource::Simulated
    };
    let sensors: Vec<String> = listed
        .drivers
        .iter()
        .filter(is_simulated_sensor)
        .map(|driver| driver.key.clone())
        .collect();
    let name = interview.ask("name of the study", Some("my study"), |_| Ok(()))?;
    let kinds = ["simulated", "rig"];
    let question = "devices, of the simulated bench or of your rig file";
    let (chosen, sensing_area) = match interview
        .choose(question, &kinds, Some("simulated"))?
        .as_str()
    {
        "rig" => (String::new(), Some(footprint(interview)?)),
        _ => (simulated(&sensors, interview)?, None),
    };
    let points = interview.count("contact points", "200", [4, 100_000])?;
    let presses = interview.count(
        "depths at each point, each sampled straight down and then moved sideways",
        "4",
        [1, 1000],
    )?;
    let models = ["ridge", "fast", "default", "best", "auto"];
    let model = interview.choose("model", &models, Some("fast"))?;
    let wanted = interview.choose("metrics", &["all", "accuracy"], Some("accuracy"))?;
    let seed = interview.count("seed of all random numbers", "7", [0, u32::MAX])?;
    let about = match sensing_area {
        Some(_) => "A study on a real rig; the rig file names the devices.",
        None => "A study on the simulated bench: nothing is measured.",
    };
    let mut text = format!(
        "# {about} `taceva plan` prints its steps.\nscene_version = 1\nname = {name:?}\nseed = {seed}\n\n"
    );
    let sensors: Vec<&str> = chosen.split(',').map(str::trim).collect();
    match (&sensing_area, sensors.as_slice()) {
        (Some(line), _) => text += &format!("[sensor]\n{line}\n"),
        (None, [sensor]) => text += &format!("[sensor]\ndriver = {sensor:?}\n\n{BENCH}"),
        (None, _) => text += BENCH,
    }
    text += &format!(
        "\n[model]\nname = {model:?}                  # ridge, fast, default, best, auto …: taceva fit --help\n\n[metrics]\nwant = [{wanted:?}]\n\n[protocol.calibration]\npoints = {points}\nindentations = {presses}\n"
    );
    if sensing_area.is_some() {
        text += "\n[protocol.contact]\ndepth_from = \"surface\"      # fitted for each press; \"contact\" counts from the first reading above threshold_N\n";
    }
    if sensors.len() > 1 {
        for sensor in sensors {
            let short = sensor.rsplit('/').next().unwrap_or(sensor);
            text +=
                &format!("\n[[study]]\nname = {short:?}\n[study.sensor]\ndriver = {sensor:?}\n");
        }
    }
    let path_word = quoted(&path);
    if sensing_area.is_some() {
        Scene::parse_for_rig(&path.display().to_string(), &text)?;
        let run = format!("taceva run {path_word} --rig rig.toml");
        return finish(
            &path,
            &text,
            &[
                format!("taceva plan {path_word} --rig rig.toml     the file of taceva init rig"),
                format!("{run} --air     every contact point in the air"),
                "taceva rig tap rig.toml     how late each device is".to_owned(),
                run,
            ],
        );
    }
    // Applies the checks of `run`.
    let scene = SceneText {
        name: path.display().to_string(),
        text: text.clone(),
        folder: path.parent().unwrap_or(Path::new("")).to_owned(),
    };
    PlannedScene::with(scene, &drivers, &Overrides::default())?;
    finish(
        &path,
        &text,
        &[
            format!("taceva plan {path_word}"),
            format!("taceva run {path_word}"),
        ],
    )
}

/// Asks for some of the simulated `sensors`, separated by commas.
fn simulated(sensors: &[String], interview: &mut Interview) -> anyhow::Result<String> {
    let known = sensors.join(", ");
    let is_known = |answer: &str| {
        let mut words = answer.split(',').map(str::trim);
        match words.find(|word| !sensors.iter().any(|sensor| sensor == word)) {
            None => Ok(()),
            Some(other) => Err(format!(
                "`{other}` is not a simulated sensor, expected any of {known}"
            )),
        }
    };
    let question = format!("sensors, separated by commas ({known})");
    interview.ask(&question, sensors.first().map(String::as_str), is_known)
}

/// Asks for the sensing area and returns its line for the scene.
fn footprint(interview: &mut Interview) -> anyhow::Result<String> {
    let expected = "expected `disc RADIUS` or `rect HALF_X HALF_Y` with lengths above 0";
    let check = |answer: &str| match footprint_line(answer) {
        Some(_) => Ok(()),
        None => Err(expected.to_owned()),
    };
    let question =
        "sensing area in mm, which no driver of a camera knows (disc RADIUS or rect HALF_X HALF_Y)";
    let answer = interview.ask(question, None, check)?;
    footprint_line(&answer).ok_or_else(|| Usage::error(expected))
}

/// Line of the scene for `disc RADIUS` or `rect HALF_X HALF_Y`; `None` for another answer.
fn footprint_line(answer: &str) -> Option<String> {
    let mut words = answer.split_whitespace();
    let shape = words.next()?;
    let lengths: Vec<f64> = words
        .map(|word| {
            let length = word.parse::<f64>().ok()?;
            (length > 0.0 && length.is_finite()).then_some(length)
        })
        .collect::<Option<_>>()?;
    match (shape, lengths.as_slice()) {
        ("disc", [radius]) => Some(format!(
            "footprint = {{ shape = \"disc\", radius_mm = {radius:?} }}"
        )),
        ("rect", [half_x, half_y]) => Some(format!(
            "footprint = {{ shape = \"rect\", half_x_mm = {half_x:?}, half_y_mm = {half_y:?} }}"
        )),
        _ => None,
    }
}
