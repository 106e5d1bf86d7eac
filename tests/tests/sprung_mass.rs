//! A sprung mass over a simple beam (Yang & Yau, J. Struct. Eng. 123, 1997: L = 25 m, E 2.87 GN/m², I 2.90 m⁴, 2,303 kg/m,
//! 5,750 kg on 1.595 MN/m at 27.78 m/s; mid-span 2.40730 mm at 0.3710 s with 20 modes), by the whole chain: car, contact,
//! rail, supports, iteration, bridge.
//!
//! A bogie whose pitch inertia is M_b L_t² moves like two masses M_b/2 over its axles that do not act on each other; the car is
//! so long that only the leading axle comes near the bridge, and rail and supports are light and stiff.

use std::path::Path;

use ttb_record::Table;
use ttb_tests::library_run;

const SCENARIO: &str = r#"{
  "train": {
    "cars": [{
      "body_mass": 1, "body_inertia": 1, "bogie_mass": 11500, "bogie_inertia": 10350000, "wheelset_mass": 1,
      "secondary_stiffness": 1, "secondary_damping": 0, "primary_stiffness": 1.595e6, "primary_damping": 0,
      "bogie_distance": 150, "wheelbase": 60, "length": 300
    }],
    "front_wheel": 0, "speed": { "m_s": 27.78 }
  },
  "contact": { "law": "linear", "wheels_per_axle": 1, "hertz_constant": 1e-9 },
  "track": {
    "type": {
      "rail": { "bending_stiffness": 2e5, "mass": 1 },
      "support": { "type": "single-layer", "fastener": { "stiffness": 1e9, "damping": 1e4 } },
      "spacing": 0.25
    },
    "from": -230, "bays": 1160
  },
  "bridge": {
    "at": 0,
    "structure": {
      "type": "beams",
      "spans": [{ "length": 25, "bending_stiffness": 8.323e9, "mass": 2303, "elements": 50 }]
    },
    "damping": { "type": "none" },
    "points": [{ "name": "mid", "x": 12.5 }]
  },
  "time": { "step": 5e-4, "end": 0.9 }
}"#;

#[test]
fn a_sprung_mass_deflects_the_beam_as_published() {
    let checked = ttb_scenario::from_str(SCENARIO, Path::new(""), "sprung mass").unwrap_or_else(|p| panic!("{p}"));
    let table = library_run(&checked);
    let mid = table.column("point[mid].displacement");
    let peak = (0..mid.len()).max_by(|a, b| mid[*a].total_cmp(&mid[*b])).expect("rows");
    let (millimetres, seconds) = (1e3 * mid[peak], table.time[peak]);
    let source = "Yang and Yau, J. Struct. Eng. 123, 1997; series of 20 modes";
    let mut record = Table::new("sprung mass over a beam of 25 m", source, "-p ttb-tests --test sprung_mass");
    record.row("peak, mm", 2.40730, millimetres, 5e-3);
    record.row("its time, s", 0.3710, seconds, 0.02);
    record.finish();
}
