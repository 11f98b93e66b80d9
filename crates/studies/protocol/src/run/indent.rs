//! Visits the waypoints of a press, and the remaining waypoints after a limit of the gel was reached.

use taceva_core::{Limit, Nanometre, Phase, PressOutcome};

use super::error::StopCause;
use super::event::Event;
use super::sample::{Gathered, Spot};
use super::session::Run;
use super::tip::{Step, Tip};
use crate::plan::PlannedPress;
use crate::press::Waypoint;

/// Greatest number of times that the tip draws back at one waypoint. Each time is at least one segment long. Noise at the limit needs one or two.
const DRAW_BACKS: u32 = 32;

impl Run<'_> {
    /// Visits the waypoints. Their depths are measured from `height_mm`.
    ///
    /// If a limit of the gel stops the tip, the tip draws back until the limit is respected. The sample of this waypoint is recorded there. Deeper
    /// waypoints are skipped. Waypoints of the unloading branch are visited from this depth.
    pub(super) fn indent(
        &mut self,
        planned: &PlannedPress,
        height_mm: f64,
        gathered: &mut Gathered,
    ) -> Step<PressOutcome> {
        let waypoints = planned.press.waypoints();
        let (mut ended_by, mut reached) = (None, None);
        for (place, number) in (0..waypoints.len()).zip(0..) {
            let spot = match reached {
                Some((limit, reached_mm)) => match after_limit(waypoints, place, reached_mm) {
                    Visit::Not => continue,
                    Visit::WhereItIs => Spot {
                        limited_by: Some(limit),
                        ..Spot::reached(number, height_mm)
                    },
                    Visit::Waypoint => Spot::reached(number, height_mm),
                },
                None => Spot::reached(number, height_mm),
            };
            match self.visit(planned, spot, gathered) {
                Ok(()) => {}
                Err(cause) => {
                    let limit = self.limit_of(cause)?;
                    let spot = Spot {
                        limited_by: Some(limit),
                        ..spot
                    };
                    let reached_mm = self.visit_at_limit(planned, spot, gathered)?;
                    ended_by = ended_by.or(Some(limit));
                    reached = Some((limit, reached_mm));
                }
            }
        }
        Ok(ended_by.map_or(PressOutcome::Complete, PressOutcome::Limited))
    }

    /// Moves to the waypoint of `spot`, and records its sample. If `spot` names a limit, the tip stays.
    fn visit(&mut self, planned: &PlannedPress, spot: Spot, gathered: &mut Gathered) -> Step<()> {
        let press = &planned.press;
        let waypoint = usize::try_from(spot.number)
            .ok()
            .and_then(|number| press.waypoints().get(number))
            .filter(|_| spot.limited_by.is_none());
        if let Some(Waypoint { depth, shear, .. }) = waypoint {
            let target = Tip::waypoint(press.place, *shear, spot.zero_mm, *depth);
            self.tip.approach(target)?;
        }
        let rested = self.tip.settle()?;
        self.sample(planned, spot, rested, gathered)
    }

    /// Limit of the gel that stopped the tip, after it was reported as an event. Any other cause is returned as an error.
    pub(super) fn limit_of(&mut self, cause: StopCause) -> Step<Limit> {
        let StopCause::Tripped(trip) = cause else {
            return Err(cause);
        };
        let limit = trip.limit().ok_or(cause)?;
        (self.events)(&Event::Halted(trip));
        Ok(limit)
    }

    /// Draws the tip back from an unreachable waypoint until it may rest, and records the sample there. Returns the depth of the tip, in mm.
    fn visit_at_limit(
        &mut self,
        planned: &PlannedPress,
        spot: Spot,
        gathered: &mut Gathered,
    ) -> Step<f64> {
        let mut draw_backs = 0;
        loop {
            self.tip.draw_back(spot.zero_mm)?;
            draw_backs += 1;
            match self.visit(planned, spot, gathered) {
                Ok(()) => return Ok(self.tip.at.position.z.0 - spot.zero_mm),
                Err(cause) if draw_backs == DRAW_BACKS => return Err(cause),
                Err(cause) => drop(self.limit_of(cause)?),
            }
        }
    }
}

/// Treatment of a waypoint after a limit of the gel stopped the press.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Visit {
    /// Skip the waypoint.
    Not,
    /// Record the sample of this turning point at the depth that was reached.
    WhereItIs,
    /// Visit the waypoint as planned.
    Waypoint,
}

/// Treatment of the waypoint with index `place`, after a limit stopped the tip at `reached_mm`.
fn after_limit(waypoints: &[Waypoint], place: usize, reached_mm: f64) -> Visit {
    let is_on_way_out = |waypoint: &Waypoint| waypoint.phase == Phase::Unload;
    let is_deeper = |depth: Nanometre| depth.to_millimetres() > reached_mm;
    let waypoint = &waypoints[place];
    let next = waypoints.get(place + 1);
    let next_is_deeper = next.is_some_and(|next| is_on_way_out(next) && is_deeper(next.depth));
    match (is_on_way_out(waypoint), is_deeper(waypoint.depth)) {
        (false, _) => Visit::Not,
        (true, true) if next_is_deeper => Visit::Not,
        (true, true) => Visit::WhereItIs,
        (true, false) => Visit::Waypoint,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::one_press::OnePress;
    use crate::run::rig::CONTACT_MM;

    #[test]
    fn after_a_limit_the_way_out_begins_where_the_way_in_ended() {
        let waypoint = |depth: i64, phase| Waypoint {
            depth: Nanometre(depth * 100_000),
            shear: [Nanometre(0); 2],
            phase,
        };
        let load = (1..=4).map(|depth| waypoint(depth, Phase::Load));
        let unload = (1..=4).rev().map(|depth| waypoint(depth, Phase::Unload));
        let waypoints: Vec<Waypoint> = load.chain(unload).collect();
        let visits = |reached_mm| {
            let visits = (3..8).map(|place| after_limit(&waypoints, place, reached_mm));
            visits.collect::<Vec<_>>()
        };
        use Visit::{Not, Waypoint as Visited, WhereItIs};
        assert_eq!(visits(0.25), [Not, Not, WhereItIs, Visited, Visited]);
        assert_eq!(visits(0.05), [Not, Not, Not, Not, WhereItIs]);
        // The unloading visits a depth that was just reached.
        assert_eq!(visits(0.3), [Not, WhereItIs, Visited, Visited, Visited]);
        // The limit acts during unloading: the gel pushes harder than before.
        assert_eq!(visits(0.39), [Not, WhereItIs, Visited, Visited, Visited]);
    }

    #[test]
    fn a_limit_that_holds_at_the_first_contact_too_ends_the_press_after_so_many_draw_backs() {
        // After the first press this gel exceeds the limit at any contact.
        let mut pressed = false;
        let force = move |question: u32, height_mm: f64| {
            pressed |= height_mm > CONTACT_MM + 0.25;
            let force_n = match (height_mm >= 0.0, pressed) {
                (false, _) => 0.0,
                (true, false) => 1.0,
                (true, true) => 2.0,
            };
            Some(force_n + f64::from(question) * 1e-6)
        };
        let press = OnePress::to(Nanometre(1_000_000), force, |_| {});
        let halts = press.count(|event| matches!(event, Event::Halted(_)));
        press.done.expect("a limit is no fault");
        let limited = PressOutcome::Limited(Limit::NormalForce);
        let [record] = &press.log.records[..] else {
            panic!("{} presses", press.log.records.len());
        };
        assert_eq!((record.outcome, record.samples.len()), (limited, 0));
        assert_eq!(halts, 1 + DRAW_BACKS);
    }
}
