//! Checks that the pressed surface is within the footprint of the sensor and the workspace of the robot.

use taceva_core::{Footprint, Millimetre, Nanometre, Point, Pose, Rotation};

use super::Gather;
use crate::footprint_spec::FootprintSpec;
use crate::rig_file::Registration;
use crate::source::RigInfo;
use crate::text::{SceneError, SceneProblem};

impl Gather<'_> {
    /// Footprint that the scene states, otherwise the rig file, otherwise the sensor. Each must be within those of the later sources.
    pub(super) fn footprint(
        &self,
        stated: Option<Footprint>,
    ) -> Result<Option<Footprint>, SceneError> {
        let (mut footprint, mut owner) = (stated, "the sensor".to_owned());
        if let Some(rig) = &self.study.rig
            && let Some(written) = self.gel().and_then(|gel| gel.footprint)
        {
            let refused = |problem| rig.error(written.at(), SceneProblem::Contradiction(problem));
            footprint = Some(within(&written.value, footprint, &owner).map_err(refused)?);
            owner = rig.text.place(written.at());
        }
        if let Some(written) = self.study.sensor.footprint {
            let refused =
                |problem| self.refusal(written.at(), SceneProblem::Contradiction(problem));
            footprint = Some(within(&written.value, footprint, &owner).map_err(refused)?);
        }
        Ok(footprint)
    }

    /// Rejects a robot that moves in its base frame if no rig file relates this frame to the sensor.
    pub(super) fn is_mapped(&self, rig: &RigInfo) -> Result<(), SceneError> {
        let robot = rig.robot.as_ref().filter(|robot| {
            let facts = robot.robot();
            self.study.rig.is_none() && facts.is_some_and(|facts| facts.base_frame)
        });
        let Some(robot) = robot else {
            return Ok(());
        };
        let written = self.study.robot.as_ref();
        let at = written.and_then(|robot| robot.driver.at());
        let robot = robot.key().to_string();
        Err(self.refusal(at, SceneProblem::Unmapped { robot }))
    }

    /// Rejects a surface that the robot cannot reach from the travel height down to the end of the search.
    pub(super) fn workspace(&self, rig: &RigInfo, footprint: &Footprint) -> Result<(), SceneError> {
        let robot = rig.robot.as_ref();
        let workspace = robot.and_then(|robot| robot.robot()?.workspace);
        let (Some(robot), Some(workspace)) = (robot, workspace) else {
            return Ok(());
        };
        let contact = &self.scene.protocol.contact;
        let [half_x, half_y] = footprint.half_extent().map(Nanometre::to_millimetres);
        let heights = [-contact.clearance_mm.value, contact.search_mm.value];
        let corner = |x: f64, y: f64, z: f64| {
            let [x, y, z] = [x, y, z].map(Millimetre);
            Point { x, y, z }
        };
        let corners = heights.into_iter().flat_map(|z| {
            [
                (-half_x, -half_y),
                (-half_x, half_y),
                (half_x, -half_y),
                (half_x, half_y),
            ]
            .map(|(x, y)| corner(x, y, z))
        });
        let rig = self.study.rig.as_ref();
        let registered = rig.and_then(|rig| {
            let robot = rig.robot.as_ref()?;
            Some((rig, Registration::new(robot, Rotation::default())))
        });
        let reached = |tip: Point| match &registered {
            Some((_, registration)) => {
                let unturned = Rotation::default();
                let tip = Pose {
                    position: tip,
                    rotation: unturned,
                };
                registration.to_base(&tip).position
            }
            None => tip,
        };
        let outside = corners
            .map(|tip| (tip, reached(tip)))
            .find(|(_, place)| !workspace.contains(place));
        let Some((tip, Point { x, y, z })) = outside else {
            return Ok(());
        };
        let key = robot.key();
        let shorter = "shorten `search_mm` or `clearance_mm`, or state a smaller footprint";
        match registered {
            None => {
                let problem =
                    format!("the robot `{key}` does not reach ({x}, {y}, {z}): {shorter}");
                let at = contact.search_mm.at();
                Err(self.refusal(at, SceneProblem::Contradiction(problem)))
            }
            Some((rig, _)) => {
                let problem = format!(
                    "the robot `{key}` does not reach ({x}, {y}, {z}) in its base frame, which is ({}, {}, {}) in the frame of the sensor. Correct `origin_mm`, `axes` or the workspace of the driver, or in the scene {shorter}",
                    tip.x, tip.y, tip.z
                );
                let robot = self.study.robot.as_ref();
                let at = robot.and_then(|robot| robot.driver.at());
                Err(rig.error(at, SceneProblem::Contradiction(problem)))
            }
        }
    }
}

/// Builds the footprint `written`. Rejects a footprint that exceeds `outer`, the footprint of `owner`.
fn within(
    written: &FootprintSpec,
    outer: Option<Footprint>,
    owner: &str,
) -> Result<Footprint, String> {
    let depth = outer.and_then(|outer| outer.depth_max());
    let footprint = written.footprint(depth.map(Nanometre::to_millimetres))?;
    let extent = footprint.half_extent();
    let reaches_out = |[outer_x, outer_y]: &[Nanometre; 2]| {
        let [half_x, half_y] = &extent;
        half_x > outer_x || half_y > outer_y
    };
    let outer = outer.as_ref().map(Footprint::half_extent);
    match outer.filter(reaches_out) {
        None => Ok(footprint),
        Some(limit) => {
            let by = |extent: [Nanometre; 2]| {
                let [x, y] = extent.map(|half| Millimetre(half.to_millimetres()));
                format!("{x} by {y}")
            };
            Err(format!(
                "the footprint extends {} from its centre, but {owner} allows at most {}: state a smaller footprint",
                by(extent),
                by(limit)
            ))
        }
    }
}
