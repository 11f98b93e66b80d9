//! First difference between the plans of a started run and the plans of a scene.

use serde_json::Value;
use taceva_core::shown;

/// Greatest number of characters of a value that a message quotes.
const MOST: usize = 60;

/// Keys of a plan whose values follow from other values. Differences in other keys are reported first.
const FOLLOWING: [&str; 3] = ["cost", "digest", "rig"];
/// Value that replaces the value of a missing key in a comparison.
static NULL: Value = Value::Null;

/// Text of the first line that differs between two scenes, such as `line 3 was …`; `None` for equal scenes.
pub(super) fn of_scenes(before: &str, now: &str) -> Option<String> {
    let mut lines = (before.lines(), now.lines());
    (1_u32..)
        .map_while(|number| match (lines.0.next(), lines.1.next()) {
            (None, None) => None,
            both => Some((number, both)),
        })
        .find(|(_, (before, now))| before != now)
        .map(|(number, (before, now))| {
            let line = |line: Option<&str>| match line {
                Some(line) => format!("`{}`", shortened(line)),
                None => "missing".to_owned(),
            };
            format!(
                "line {number} of the scene was {} and is now {}",
                line(before),
                line(now)
            )
        })
}

/// True if two texts have equal plans. `before` may lack the name of the operator, which earlier builds did not write.
pub(super) fn are_same_plans(before: &str, now: &str) -> bool {
    let read = |text: &str| serde_json::from_str::<Value>(text).ok();
    let same = |(before, now): (Value, Value)| of_values("", &before, &now).is_none();
    before == now || read(before).zip(read(now)).is_some_and(same)
}

/// Text of the first value that differs between two texts of plans, such as `studies.0.seed was 1 and is now 2`; `None` for equal plans.
pub(super) fn of_plans(before: &str, now: &str) -> Option<String> {
    let read = |text: &str| serde_json::from_str::<Value>(text).ok();
    of_values("", &read(before)?, &read(now)?)
}

fn of_values(path: &str, before: &Value, now: &Value) -> Option<String> {
    let inner = |name: &str| match path {
        "" => name.to_owned(),
        path => format!("{path}.{name}"),
    };
    match (before, now) {
        (Value::Object(before), Value::Object(now)) => {
            let names = before.keys().chain(now.keys());
            let (last, first): (Vec<&String>, Vec<&String>) =
                names.partition(|name| FOLLOWING.contains(&name.as_str()));
            let mut names = first.into_iter().chain(last);
            names.find_map(|name| {
                let [before, now] = [before, now].map(|map| map.get(name).unwrap_or(&NULL));
                of_values(&inner(name), before, now)
            })
        }
        (Value::Array(before), Value::Array(now)) if before.len() == now.len() => {
            let mut pairs = before.iter().zip(now).enumerate();
            pairs.find_map(|(at, (before, now))| of_values(&inner(&at.to_string()), before, now))
        }
        (Value::Array(before), Value::Array(now)) => Some(format!(
            "{path} had {} entries and has {}",
            before.len(),
            now.len()
        )),
        (before, now) if before == now => None,
        // The plan has the digest of the rig file, and its operator.
        _ if path == "rig" => Some("the rig file changed".to_owned()),
        // An earlier build stored no operator. If a person added the name, the rig file differs too.
        (Value::Null, _) if path == "operator" => None,
        (before, now) if path == "operator" => Some(format!(
            "the operator was {} and is now {} (`name` under [operator] of the rig file)",
            person(before),
            person(now)
        )),
        (before, now) => Some(format!(
            "{path} was {} and is now {}",
            shortened(&before.to_string()),
            shortened(&now.to_string())
        )),
    }
}

/// Words for the name of an operator, quoted, or `not named`.
fn person(name: &Value) -> String {
    let name = name.as_str().map(|name| format!("`{}`", shortened(name)));
    name.unwrap_or_else(|| "not named".to_owned())
}

fn shortened(text: &str) -> String {
    let text = text.trim();
    match text.chars().count() {
        count if count > MOST => {
            let start: String = text.chars().take(MOST).collect();
            format!("{}…", shown(&start))
        }
        _ => shown(text).to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_that_differs_is_named_with_both_texts() {
        let scene = "name = \"a\"\n[limits]\nFz_max_N = 20\n";
        assert_eq!(of_scenes(scene, scene), None);
        assert_eq!(
            of_scenes(scene, &scene.replace("20", "15")).as_deref(),
            Some("line 3 of the scene was `Fz_max_N = 20` and is now `Fz_max_N = 15`")
        );
        assert_eq!(
            of_scenes(scene, "name = \"a\"\n").as_deref(),
            Some("line 2 of the scene was `[limits]` and is now missing")
        );
    }

    #[test]
    fn another_operator_is_named_before_the_rig_file_that_names_both() {
        let before = r#"{"rig": "sha256:1", "operator": "Ada"}"#;
        let found = |now: &str| of_plans(before, now).unwrap_or_default();
        assert_eq!(
            found(r#"{"rig": "sha256:2", "operator": "Grace"}"#),
            "the operator was `Ada` and is now `Grace` (`name` under [operator] of the rig file)"
        );
        let nobody = found(r#"{"rig": "sha256:2"}"#);
        assert!(
            nobody.contains("was `Ada` and is now not named"),
            "{nobody}"
        );
    }

    #[test]
    fn a_plan_of_an_earlier_build_without_an_operator_is_the_same_plan() {
        let plan = |rig: &str| format!(r#"{{"seed": 1, "rig": "{rig}"}}"#);
        let now = r#"{"seed": 1, "rig": "sha256:1", "operator": "Ada"}"#;
        assert!(are_same_plans(&plan("sha256:1"), now));
        assert!(!are_same_plans(now, &plan("sha256:1")));
        assert!(!are_same_plans("no plan", now));
        let other = plan("sha256:2");
        assert!(!are_same_plans(&other, now));
        assert_eq!(
            of_plans(&other, now).as_deref(),
            Some("the rig file changed")
        );
    }

    #[test]
    fn the_first_value_that_differs_is_named_by_its_path() {
        let plan = |limit: u32, shear: &str, rig: &str| {
            format!(
                r#"{{"rig": "{rig}", "studies": [{{"digest": "{limit}{shear}", "limits": {{"Fz": {limit}}}, "presses": [{{"shear": {shear}}}]}}]}}"#
            )
        };
        let before = plan(20, "null", "sha256:1");
        let found = |now: &str| of_plans(&before, now).unwrap_or_default();
        assert_eq!(found(&before), "");
        assert_eq!(
            found(&plan(15, "null", "sha256:1")),
            "studies.0.limits.Fz was 20 and is now 15"
        );
        assert_eq!(
            found(&plan(20, "0.5", "sha256:1")),
            "studies.0.presses.0.shear was null and is now 0.5"
        );
        assert_eq!(found(&plan(20, "null", "sha256:2")), "the rig file changed");
        let fewer = before.replace(r#"{"shear": null}"#, "");
        assert_eq!(found(&fewer), "studies.0.presses had 1 entries and has 0");
        assert_eq!(found("no plan"), "");
    }
}
