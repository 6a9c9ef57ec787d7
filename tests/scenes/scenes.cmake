keyblock_scene(verification/incline_25)
keyblock_scene(verification/incline_30 RANKS 1 2 4)
keyblock_scene(verification/incline_35)
