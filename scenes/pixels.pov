// pixels.pov - picture.exr with its values as a display shows pixels of them, by no curve: what [Okumura] calls levels.

#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z direction z right x up y }
box {
  0, <1, 1, 0.01>
  texture {
    pigment { image_map { exr "picture.exr" gamma srgb } }
    finish { ambient 0 emission 1 diffuse 0 }
  }
  translate <-0.5, -0.5, 0>
}
