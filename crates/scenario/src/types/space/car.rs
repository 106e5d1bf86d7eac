//! What a car has in space beside its plane data.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A car in space: roll and yaw, lateral and longitudinal springs, heights. Vertical springs and dampers are those of the
/// plane data, half of them on each side. Stiffness and damping are per axle box (primary) and per side of a bogie (secondary).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct CarInSpace {
    /// Roll and yaw inertia of the body I_x, I_z, kg m².
    pub body: RollYaw,
    /// Roll and yaw inertia of a bogie, kg m².
    pub bogie: RollYaw,
    /// Roll, spin and yaw inertia of a wheelset, kg m².
    pub wheelset: WheelsetInertia,
    /// Radius of the wheels r0, m; absent: `contact.wheel_radius`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wheel_radius: Option<f64>,
    /// Height of the body's centre of gravity above the rail's top h_c, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub body_height: f64,
    /// Height of a bogie's centre of gravity h_b, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bogie_height: f64,
    /// Between bogie and axle boxes.
    pub primary: Suspension,
    /// Between body and bogies.
    pub secondary: Secondary,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
}

/// Inertia about x and z, kg m².
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct RollYaw {
    /// About x.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub roll: f64,
    /// About z.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub yaw: f64,
}

/// Inertia of a wheelset, kg m².
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct WheelsetInertia {
    /// About x.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub roll: f64,
    /// About its own axle.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spin: f64,
    /// About z.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub yaw: f64,
}

/// Springs and dashpots in the plane of the track, and where they stand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Suspension {
    /// Longitudinal stiffness, N/m.
    #[schemars(range(min = 0))]
    pub longitudinal_stiffness: f64,
    /// Lateral stiffness, N/m.
    #[schemars(range(min = 0))]
    pub lateral_stiffness: f64,
    /// Longitudinal damping, N s/m.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub longitudinal_damping: f64,
    /// Lateral damping, N s/m.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub lateral_damping: f64,
    /// Half the distance of the springs, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_distance: f64,
    /// Their height above the rail's top, m.
    #[schemars(range(min = 0))]
    pub height: f64,
}

/// Between body and bogies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Secondary {
    /// Springs and dashpots of a side.
    pub springs: Suspension,
    /// Height of the lateral dampers above the rail's top, m; absent: that of the springs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub lateral_damper_height: Option<f64>,
    /// Half the distance of the vertical dampers, m; absent: that of the springs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub vertical_damper_half_distance: Option<f64>,
    /// Anti-roll bar of a bogie, N m/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub anti_roll: Option<f64>,
    /// Yaw damper of a side; absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw_damper: Option<YawDamper>,
    /// Lateral bump stop of a bogie; absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bump_stop: Option<BumpStop>,
}

/// A longitudinal damper between body and bogie, one on each side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct YawDamper {
    /// Damping, N s/m.
    #[schemars(range(min = 0))]
    pub damping: f64,
    /// Force from which the damper yields, N; absent: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub blow_off: Option<f64>,
    /// Damping beyond that force, N s/m.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub damping_beyond: f64,
    /// Stiffness of its mounts in series, N/m; absent: rigid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub series_stiffness: Option<f64>,
    /// Half the distance of both dampers, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub half_distance: f64,
    /// Height above the rail's top, m.
    #[schemars(range(min = 0))]
    pub height: f64,
}

/// A stop that takes force behind a gap, the same to both sides.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct BumpStop {
    /// Points (m, N): the first one is the gap, with force 0; beyond the last one its slope goes on.
    #[schemars(length(min = 2))]
    pub points: Vec<[f64; 2]>,
    /// Height above the rail's top, m; absent: that of the lateral dampers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub height: Option<f64>,
}
