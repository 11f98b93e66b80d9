//! `meta/info.json`: version, paths of files, and features.

use serde_json::Value;

use super::depth::{self, DepthCodes};
use super::pattern::Pattern;
use crate::error::{Place, TableError, shown};
use crate::source::Source;

/// Supported layouts of a LeRobot dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// Version 2.1: one data file per episode, and JSON lines that describe the episodes.
    V21,
    /// Version 3.0: data files shared by episodes, and Parquet files that describe the episodes.
    V30,
}

/// A column of a LeRobot dataset, from `meta/info.json`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Feature {
    /// Name, such as `observation.state`.
    pub name: String,
    /// `video`, `image`, or the type of the numbers, such as `float32`.
    pub dtype: String,
    /// Lengths of the axes in one row. For pictures: height, width and colours.
    pub shape: Vec<u64>,
    /// Names of the numbers, in order; empty if not stated.
    pub names: Vec<String>,
    /// Frame rate of a video, 1/s: stated by the video, otherwise by the dataset. 0 for other features if the dataset states no rate.
    pub fps: f64,
    /// True for a depth map. Its 12-bit codes are distances, not brightness.
    pub is_depth: bool,
    /// Distances of the codes of a depth map; `None` if the feature does not state them or is not a depth map.
    pub depth: Option<DepthCodes>,
}

#[derive(Debug)]
pub(super) struct Info {
    pub(super) layout: Layout,
    pub(super) data: Pattern,
    pub(super) video: Option<Pattern>,
    pub(super) chunks_size: u64,
    pub(super) features: Vec<Feature>,
    /// Names of depth maps whose codes have unknown distances, each with the reason.
    pub(super) unknown_depths: Vec<(String, String)>,
}

/// Parses `json`, the content of the file `source`.
pub(super) fn parse(source: &Source, json: &Value) -> Result<Info, TableError> {
    let wrong = |name: &str, problem: String| source.damaged(Place::of(name), problem);
    let text = |name: &str| {
        let found = json.get(name).and_then(Value::as_str);
        found.ok_or_else(|| wrong(name, "expected a string".to_owned()))
    };
    let layout = match text("codebase_version")? {
        // tlabel writes its own name before the version.
        "v2.1" | "lerobot-v2.1" => Layout::V21,
        "v3.0" => Layout::V30,
        other => {
            let problem = format!(
                "version `{}`, expected v2.1 or v3.0; convert older versions with the scripts under `lerobot/datasets`",
                shown(other)
            );
            return Err(source.unsupported(Place::of("codebase_version"), problem));
        }
    };
    let pattern = |name: &str| Pattern::parse(text(name)?).map_err(|problem| wrong(name, problem));
    let video = match json.get("video_path") {
        None | Some(Value::Null) => None,
        Some(_) => Some(pattern("video_path")?),
    };
    // A dataset without videos may omit the rate.
    let fps = match json.get("fps") {
        None | Some(Value::Null) => None,
        Some(stated) => {
            let fps = stated.as_f64().filter(|fps| is_rate(*fps));
            Some(fps.ok_or_else(|| wrong("fps", "expected frames per second".to_owned()))?)
        }
    };
    let listed = json.get("features").and_then(Value::as_object);
    let listed = listed.ok_or_else(|| wrong("features", "expected an object".to_owned()))?;
    let mut features = Vec::with_capacity(listed.len());
    let mut unknown_depths = Vec::new();
    for (name, feature) in listed {
        let dtype = feature.get("dtype").and_then(Value::as_str);
        let dtype = dtype.ok_or_else(|| wrong(name, "the feature has no `dtype`".to_owned()))?;
        let shape = feature.get("shape").and_then(Value::as_array);
        let own = ["info", "video_info"]
            .iter()
            .find_map(|key| feature.get(*key)?.get("video.fps")?.as_f64());
        let own = own.filter(|fps| is_rate(*fps)).or(fps);
        if own.is_none() && dtype == "video" {
            return Err(wrong("fps", "expected frames per second".to_owned()));
        }
        let is_depth = ["info", "video_info"].iter().any(|key| {
            let info = feature.get(*key);
            let says = |name: &str| info.and_then(|info| info.get(name)?.as_bool()) == Some(true);
            says("is_depth_map") || says("video.is_depth_map")
        });
        let codes = is_depth.then(|| depth::codes(feature)).transpose();
        if let Err(problem) = &codes {
            unknown_depths.push((name.clone(), problem.clone()));
        }
        features.push(Feature {
            name: name.clone(),
            dtype: dtype.to_owned(),
            shape: shape
                .into_iter()
                .flatten()
                .filter_map(Value::as_u64)
                .collect(),
            names: ["names", "feature_names"]
                .iter()
                .find_map(|key| feature.get(*key).map(names))
                .unwrap_or_default(),
            fps: own.unwrap_or_default(),
            is_depth,
            depth: codes.unwrap_or_default(),
        });
    }
    Ok(Info {
        layout,
        data: pattern("data_path")?,
        video,
        chunks_size: json
            .get("chunks_size")
            .and_then(Value::as_u64)
            .unwrap_or(1000)
            .max(1),
        features,
        unknown_depths,
    })
}

/// Names of a feature in `info.json`: a list of texts, or lists in a dictionary, such as `{"motors": ["x", "y"]}`.
fn names(written: &Value) -> Vec<String> {
    let lists: Vec<&Value> = match written {
        Value::Object(lists) => lists.values().collect(),
        list => vec![list],
    };
    let texts = lists.into_iter().filter_map(Value::as_array).flatten();
    texts
        .map(|text| text.as_str().unwrap_or_default().to_owned())
        .collect()
}

fn is_rate(fps: f64) -> bool {
    fps > 0.0 && fps < 1e6
}
