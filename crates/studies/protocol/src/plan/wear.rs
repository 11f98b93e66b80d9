//! Load cycles of a stage of wear. They are added before the measured presses, when all passes are done. No pass removes them.

use std::fmt;

use taceva_core::counted;

use super::collect::PlannedPress;
use super::cost::cost;
use super::study_facts::StudyFacts;
use crate::press::{Motion, Press};
use crate::scene::{Study, WearStage};
use crate::text::SceneProblem;

/// Wear of the gel before the measured presses of a plan.
///
/// Plans contain this value; callers only read it.
///
/// ```
/// use taceva_protocol::Plan;
///
/// fn cycles(plan: &Plan) -> u32 {
///     plan.wear.as_ref().map_or(0, |wear| wear.cycles)
/// }
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct PlannedWear {
    /// Name of the study in the scene, common to the plans of all its stages of wear.
    pub sensor: String,
    /// Kind of load of a cycle: compression, shear or abrasion.
    pub load: String,
    /// Normal force of a cycle, in N.
    #[serde(rename = "force_N")]
    pub force_n: f64,
    /// Sideways travel of a cycle, in mm; `None` for compression.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel_mm: Option<f64>,
    /// Number of cycles of the plan.
    pub cycles: u32,
    /// Number of presses on the gel before the first measured press, if the run makes every planned press.
    pub presses_since_gel: u32,
    /// Time of the cycles, in minutes. The cost of the plan includes this time.
    pub minutes: f64,
}

/// Formats the cycles, their time, and the number of earlier presses.
impl fmt::Display for PlannedWear {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cycles = counted(self.cycles, "cycle");
        write!(f, "{cycles} of {} to {} N", self.load, self.force_n)?;
        if let Some(travel_mm) = self.travel_mm {
            write!(f, " over {travel_mm} mm")?;
        }
        let presses = counted(self.presses_since_gel, "press");
        let hours = self.minutes / 60.0;
        write!(f, ", ~{hours:.1} h; {presses} before the measured ones")
    }
}

/// Puts the load cycles of `study` before its `presses`. Returns `None` for a study without stages of wear.
pub(super) fn put_before(
    presses: &mut Vec<PlannedPress>,
    study: &Study,
    facts: &StudyFacts<'_>,
) -> Result<Option<PlannedWear>, SceneProblem> {
    let Some(stage) = &study.wear else {
        return Ok(None);
    };
    let spec = facts
        .phase_inputs
        .as_ref()
        .and_then(|inputs| Some((inputs, inputs.protocol.wear.as_ref()?)));
    let Some((inputs, spec)) = spec else {
        let problem = format!(
            "study `{}` has [protocol.wear], but nothing that presses: expected a robot and a footprint",
            study.name
        );
        return Err(SceneProblem::Contradiction(problem));
    };
    let loads: Vec<PlannedPress> = inputs.loads(stage).into_iter().map(unseen).collect();
    let minutes = cost(&loads, facts).minutes;
    let presses_since_gel = since_gel(spec.presses_since_gel, stage, presses);
    let measured = std::mem::replace(presses, loads);
    presses.extend(measured);
    Ok(Some(PlannedWear {
        sensor: stage.sensor.clone(),
        load: spec.load.value.clone(),
        force_n: spec.force_n.value,
        travel_mm: spec.travel_mm.map(|travel| travel.value),
        cycles: stage.added,
        presses_since_gel,
        minutes,
    }))
}

/// Number of presses on the gel before the measured presses of `stage`: presses before the run, cycles, and measured presses of earlier stages.
fn since_gel(before: u32, stage: &WearStage, measured: &[PlannedPress]) -> u32 {
    let touches = |press: &&PlannedPress| !matches!(press.press.motion, Motion::Rest { .. });
    let touching = measured.iter().filter(touches).count();
    let of_stages = u32::try_from(touching)
        .unwrap_or(u32::MAX)
        .saturating_mul(stage.number);
    before
        .saturating_add(stage.cycles)
        .saturating_add(of_stages)
}

/// Planned press for a load cycle, without phases and frames.
fn unseen(press: Press) -> PlannedPress {
    PlannedPress {
        id: press.id(),
        press,
        phases: Vec::new(),
        frames: false,
    }
}
