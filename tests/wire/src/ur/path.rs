//! Path of a public client: motions that the client writes into its script before it sends the script.

use super::joints;

/// A motion of a path. The radius that blends it with the next motion is ignored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Waypoint {
    /// Pose of the tip in m and rad.
    pub(super) pose: [f64; 6],
    pub(super) speed_m_s: f64,
}

/// Line of the client's script before the motions of the path.
const BEGIN: &str = "# inject move path\n";

/// Motions in `script`; none if it has no path, or if a motion is not emulated.
pub(super) fn of(script: &str) -> Vec<Waypoint> {
    let Some((_, path)) = script.split_once(BEGIN) else {
        return Vec::new();
    };
    let lines = path.lines().map(str::trim);
    let motions = lines
        .take_while(|line| *line != "end")
        .filter(|line| !line.is_empty() && !line.starts_with("signal_async_progress("));
    let waypoints: Option<Vec<Waypoint>> = motions.map(Waypoint::read).collect();
    waypoints.unwrap_or_default()
}

impl Waypoint {
    fn read(line: &str) -> Option<Waypoint> {
        let (motion, call) = line.split_once('(')?;
        let (place, rest) = call.split_once(']')?;
        let (kind, place) = place.split_once('[')?;
        let &[a, b, c, d, e, f] = &numbers(place)?[..] else {
            return None;
        };
        let six = [a, b, c, d, e, f];
        let pose = match kind {
            "p" => six,
            "" => joints::pose(six),
            _ => return None,
        };
        let (_, speed) = rest.split_once("v=")?;
        let speed: f64 = speed.split([',', ')']).next()?.trim().parse().ok()?;
        let speed_m_s = match motion {
            "movej" => joints::tip_speed_m_s(pose, speed),
            "movel" | "movep" => speed,
            _ => return None,
        };
        Some(Waypoint { pose, speed_m_s })
    }
}

/// Numbers separated by commas; `None` if one is invalid.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |number: &str| number.trim().parse().ok();
    let numbers = text.split(',').map(number);
    let finite = numbers.map(|number| number.filter(|number: &f64| number.is_finite()));
    finite.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn script(motions: &str) -> String {
        format!(
            "def rtde_control():\n    def exec_move_path():\n        # inject move path\n{motions}    end\n    other()\nend\n"
        )
    }

    #[test]
    fn the_motions_of_a_path_are_read_in_their_order() {
        let text = script(
            "\tsignal_async_progress(0)\n\tmovel(p[0.3,0.002,0.268,3.1,0,0],a=0.5,v=0.05,r=0)\n\tsignal_async_progress(1)\n\tmovep(p[0.3,0,0.27,3.1,0,0],a=0.5,v=0.1,r=0.001)\n",
        );
        let expected = [
            ([0.3, 0.002, 0.268, 3.1, 0.0, 0.0], 0.05),
            ([0.3, 0.0, 0.27, 3.1, 0.0, 0.0], 0.1),
        ]
        .map(|(pose, speed_m_s)| Waypoint { pose, speed_m_s });
        assert_eq!(of(&text), expected);
        let joints = of(&script("\tmovej([0,0,0,0,0,0],a=1,v=0.2,r=0)\n"));
        assert!((joints[0].pose[0] + 0.817_25).abs() < 1e-6, "{joints:?}");
        assert!(joints[0].speed_m_s > 0.16, "{joints:?}");
    }

    #[test]
    fn a_script_without_a_path_or_with_another_motion_has_none() {
        assert!(of("def rtde_control():\nend\n").is_empty());
        assert!(of(&script("")).is_empty());
        let circle = "\tmovel(p[0,0,0,0,0,0],a=1,v=1,r=0)\n\tmovec(p[0,0,0,0,0,0],p[0,0,0,0,0,0],a=1,v=1,r=0)\n";
        assert!(of(&script(circle)).is_empty());
    }
}
