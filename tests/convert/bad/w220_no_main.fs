/*{ "INPUTS": [] }*/
float half_ = 0.5;
