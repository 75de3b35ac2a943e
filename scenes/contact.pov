// contact.pov - twelve frames of the film on a sheet, evenly spread over Frames; street.sh calls it.  Render with
// +W1304 +H743.

#version 3.7;
#ifndef (Frames) #declare Frames = 48; #end
#declare Columns = 4;
#declare Rows = 3;
#declare Gap = 8;
#declare Sheet_Width = 1304;
#declare Sheet_Height = 743;
#declare Wide = (Sheet_Width - Gap) / Columns - Gap;
#declare High = Wide * 3 / 4;

global_settings { assumed_gamma 1 }
background { rgb 1 }
camera {
  orthographic
  location <Sheet_Width / 2, Sheet_Height / 2, -20>
  direction z
  right Sheet_Width * x
  up Sheet_Height * y
}

#for (I, 0, Columns * Rows - 1)
  #local Number = 1 + int(I * (Frames - 1) / (Columns * Rows - 1) + 0.5);
  box {
    0, <1, 1, 0.01>
    texture {
      pigment { image_map { png concat("teapot8_", str(Number, -3, 0), ".png") interpolate 2 } }
      finish { ambient 0 emission 1 diffuse 0 }
    }
    scale <Wide, High, 1>
    translate <Gap + mod(I, Columns) * (Wide + Gap), Sheet_Height - (int(I / Columns) + 1) * (High + Gap), 0>
  }
#end
