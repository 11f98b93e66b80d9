//! Faults that a run adds to the pictures of a scene, to test the model.

use serde::Deserialize;

use crate::text::Setting;

/// Faults that a run adds to the pictures of each test part, to test the model. For an absent key, the default of `taceva stress` applies.
///
/// The table `[stress]` of a scene sets them; callers only read them.
///
/// ```
/// use taceva_protocol::Scene;
/// let text = r#"
/// scene_version = 1
/// name = "worn"
/// sensor = { dataset = "monday" }
/// stress = { faults = ["tear", "dust"], severities = [1, 3, 5] }
/// "#;
/// let stress = Scene::parse("worn.toml", text)?.stress.expect("written");
/// assert_eq!(stress.severities(), [1, 3, 5]);
/// assert_eq!(stress.draws(), 1);
/// # Ok::<(), taceva_protocol::SceneError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(
    deny_unknown_fields,
    default,
    expecting = "a table with `faults`, `severities` and `seeds`"
)]
#[non_exhaustive]
pub struct StressSpec {
    /// Names of faults, or of lists of faults; all faults if absent.
    pub faults: Option<Vec<Setting<String>>>,
    /// Severities of the faults, ascending, from 1 to [`MOST`](StressSpec::MOST); all if absent.
    pub severities: Option<Vec<Setting<u32>>>,
    /// Number of random draws of the places of dead pixels, scratches, tears and dust; 1 if absent.
    pub seeds: Option<Setting<u32>>,
}

/// Fault that a plugin adds to pictures.
///
/// A table `[[fault]]` of a scene sets it; callers only read it.
///
/// ```
/// use taceva_protocol::Scene;
/// let text = r#"
/// scene_version = 1
/// name = "fog"
/// sensor = { dataset = "monday" }
/// stress = {}
/// fault = [{ name = "fog", plugin = "org.example.fogged-lens/fog" }]
/// "#;
/// let scene = Scene::parse("fog.toml", text)?;
/// assert_eq!(scene.faults[0].name.value, "fog");
/// # Ok::<(), taceva_protocol::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `name` and `plugin`")]
#[non_exhaustive]
pub struct PluginFaultSpec {
    /// Name of the fault in results.
    pub name: Setting<String>,
    /// Key of the plugin's estimator that adds the fault, such as `org.example.fogged-lens/fog`.
    pub plugin: Setting<String>,
}

impl StressSpec {
    /// Highest severity of a fault.
    pub const MOST: u32 = 5;
    /// Greatest number of random draws of the places of a fault.
    pub const DRAWS: u32 = 100;

    /// Severities of the faults, ascending.
    pub fn severities(&self) -> Vec<u8> {
        let all = 1..=StressSpec::MOST;
        let wanted: Vec<u32> = match &self.severities {
            Some(severities) => severities.iter().map(|of| of.value).collect(),
            None => all.collect(),
        };
        let small = wanted.into_iter().filter_map(|of| u8::try_from(of).ok());
        small.collect()
    }

    /// Number of random draws of the places of a fault.
    pub fn draws(&self) -> u32 {
        self.seeds.map_or(1, |seeds| seeds.value)
    }
}
