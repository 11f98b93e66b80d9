//! Descriptor and arguments of a simulated sensor.

use taceva_core::{
    ArgSpec, ArgValue, Args, DescriptorSpec, DriverKey, DriverSource, Facts, Footprint, FrameInfo,
    Hertz, Millimetre, Newton, SensorFacts,
};

use crate::drive::error::rig_argument;
use crate::drive::lighting::scenes;
use crate::optics::{Bits, OpticsSpec};
use crate::parameters::{Body, GelFault, Model, Outline, Parameters};

/// Key of the driver of a model.
pub(super) fn key(model: Model) -> DriverKey {
    match model {
        Model::ViTacTip => DriverKey::fixed("sim/vitactip"),
        Model::MagicTac => DriverKey::fixed("sim/magictac"),
        Model::GelSight => DriverKey::fixed("sim/gelsight"),
        Model::GelSightWm => DriverKey::fixed("sim/gelsight-wm"),
    }
}

/// Descriptor of the sensor before it is opened.
pub(super) fn describe(
    model: Model,
    parameters: &Parameters,
    frame: Option<FrameInfo>,
) -> DescriptorSpec {
    let depth_max_mm = parameters.probing.depth_max_mm;
    let footprint = match parameters.outline() {
        Outline::Disc { radius_mm } => Footprint::disc(radius_mm, Some(depth_max_mm)),
        Outline::Rectangle { half_mm: [x, y] } => Footprint::rectangle(x, y, Some(depth_max_mm)),
    };
    let surface = &parameters.surface;
    let is_transparent = parameters.camera.transparency > 0.5;
    let facts = SensorFacts::default()
        .with_frame(frame)
        .with_rate(Hertz(parameters.camera.rate_hz))
        .with_opaque(!is_transparent)
        .with_markers(parameters.markers.is_some() || parameters.lattice.is_some())
        .with_scenes(if is_transparent { scenes() } else { Vec::new() })
        .with_footprint(footprint.ok())
        .with_depth_max(Millimetre(depth_max_mm))
        .with_force_max(Newton(parameters.probing.force_max_n))
        .with_camera([parameters.camera.width_px, parameters.camera.height_px].map(pixels))
        .with_gel_thickness(match parameters.body {
            Body::Layer(layer) => Some(Millimetre(layer.thickness_mm)),
            Body::Dome(_) => None,
        })
        .with_field_of_view_mm2(match parameters.body {
            Body::Layer(_) => surface.width_mm * surface.height_mm,
            Body::Dome(_) => std::f64::consts::FRAC_PI_4 * surface.width_mm * surface.height_mm,
        });
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
            .help("seed of all noise of the bench"),
        ArgSpec::whole("unit", 0, UNITS)
            .default(ArgValue::Whole(0))
            .help("number of the unit of the sensor; 0 is nominal"),
        ArgSpec::whole("reduction", 1, REDUCTIONS)
            .optional()
            .help("camera pixels for each pixel of the frame, along x and along y")
            .changes_facts(),
        ArgSpec::choice("bits", Bits::ALL.map(Bits::name))
            .optional()
            .help("bits of a sample; default 8 for full frames, 16 for reduced frames")
            .changes_facts(),
        ArgSpec::text("table")
            .optional()
            .help("full text of a parameter table that replaces the built-in one")
            .changes_facts(),
        ArgSpec::choice("fault", GelFault::ALL.map(GelFault::name))
            .optional()
            .help("fault of the gel, which changes force and picture together")
            .changes_facts(),
        ArgSpec::whole("severity", 1, 5)
            .default(ArgValue::Whole(1))
            .help("severity of the fault"),
        ArgSpec::flag("ages").default(ArgValue::Flag(false)).help(
            "the gel ages by the forces of earlier presses, at the rates under [ageing] of its table, otherwise at rates chosen for the simulation",
        ),
        ArgSpec::number("load_kn", 0.0, LOAD_KN)
            .default(ArgValue::Number(0.0))
            .help("sum of the forces of earlier presses, kN; [protocol.wear] of a scene sets it"),
        ArgSpec::flag("quiet").default(ArgValue::Flag(false)).help(
            "disables noise, drift and relaxation, so output depends only on the pose of the tip",
        ),
    ])
}

/// Maximum sum of the forces of earlier presses, kN.
const LOAD_KN: f64 = 1000.0;
/// Maximum unit number.
const UNITS: i64 = 1_000_000;
/// Maximum reduction factor of the frame size.
const REDUCTIONS: i64 = 64;
/// Approximate default length of the longer side of a frame, pixels.
const LONGER_SIDE: u32 = 160;

/// Reduction factor of the frame size that `args` request.
pub(super) fn reduction(args: &Args, parameters: &Parameters) -> u32 {
    match args.get("reduction") {
        Some(&ArgValue::Whole(reduction)) => u32::try_from(reduction).unwrap_or(1),
        _ => default_reduction(parameters),
    }
}

/// Default reduction factor of the frame size.
pub(super) fn default_reduction(parameters: &Parameters) -> u32 {
    let [width, height] = OpticsSpec::new(parameters).native;
    (width.max(height) / LONGER_SIDE).clamp(1, 64)
}

/// Fault of the gel that `args` request, with its severity, 1 to 5; `None` if no fault is requested.
pub(super) fn fault(args: &Args) -> Option<(GelFault, u8)> {
    let name = args.get("fault").and_then(ArgValue::as_text)?;
    let severity = u8::try_from(args.whole("severity")).unwrap_or(1);
    Some((GelFault::from_name(name)?, severity))
}

/// Size of a reduced frame, pixels.
pub(super) fn reduced(native: [u32; 2], reduction: u32) -> [u32; 2] {
    native.map(|side| (side / reduction).max(1))
}

/// Bits of a sample that `args` request; `None` for the default.
pub(super) fn bits(args: &Args) -> Option<Bits> {
    let name = args.get("bits").and_then(ArgValue::as_text)?;
    Bits::ALL.into_iter().find(|bits| bits.name() == name)
}

/// Frame of a sensor with these parameters; `None` if they are invalid. The call to open the sensor reports the details.
pub(super) fn frame(
    parameters: &Parameters,
    reduction: u32,
    bits: Option<Bits>,
) -> Option<FrameInfo> {
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
