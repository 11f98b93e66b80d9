//! A scene and its studies, as parsed from TOML before any check.

use serde::Deserialize;

use super::recording::WrittenRecording;
use crate::limit_spec::LimitSpec;
use crate::scene::counts::Protocol;
use crate::scene::devices::{DeviceSpec, LightingSpec, ModelSpec, SensorSpec};
use crate::scene::metrics::{MetricsSpec, ReportSpec};
use crate::scene::stress::{PluginFaultSpec, StressSpec};
use crate::text::Setting;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a scene")]
pub(super) struct WrittenScene {
    pub(super) scene_version: Setting<u32>,
    pub(super) name: Setting<String>,
    #[serde(default)]
    pub(super) seed: u64,
    pub(super) rig: Option<Setting<String>>,
    pub(super) sensor: Option<Setting<SensorSpec>>,
    pub(super) robot: Option<DeviceSpec>,
    pub(super) force: Option<DeviceSpec>,
    pub(super) lighting: Option<LightingSpec>,
    #[serde(default)]
    pub(super) limits: LimitSpec,
    pub(super) model: Option<Setting<ModelSpec>>,
    #[serde(default)]
    pub(super) recording: WrittenRecording,
    #[serde(default)]
    pub(super) metrics: MetricsSpec,
    #[serde(default)]
    pub(super) protocol: Protocol,
    #[serde(default)]
    pub(super) report: ReportSpec,
    pub(super) stress: Option<StressSpec>,
    #[serde(default)]
    pub(super) fault: Vec<PluginFaultSpec>,
    #[serde(default)]
    pub(super) study: Vec<Setting<WrittenStudy>>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a study")]
pub(super) struct WrittenStudy {
    pub(super) name: Setting<String>,
    pub(super) sensor: Option<Setting<SensorSpec>>,
    pub(super) robot: Option<DeviceSpec>,
    pub(super) force: Option<DeviceSpec>,
    pub(super) lighting: Option<LightingSpec>,
    #[serde(default)]
    pub(super) limits: LimitSpec,
    pub(super) model: Option<Setting<ModelSpec>>,
    #[serde(default)]
    pub(super) recording: WrittenRecording,
}
